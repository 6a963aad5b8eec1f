// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/cpu_quota.hpp"
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

namespace piola::exec_host {
namespace {

namespace fs = std::filesystem;

/// quota / period; infinite if one is missing or the quota is "max" or -1. Periods of less than a microsecond and more
/// than the thousand seconds that the kernel allows are not believed.
double share(std::istream& quota, std::istream& period) {
  double time = 0, each = 0;
  bool const limited = (quota >> time) && (period >> each) && time > 0 && each >= 1 && each <= 1e9;
  return limited ? time / each : HUGE_VAL;
}

double limit_of(fs::path const& group) {
  std::ifstream both(group / "cpu.max"), quota(group / "cpu.cfs_quota_us"), period(group / "cpu.cfs_period_us");
  return std::min(share(both, both), share(quota, period));
}

/// The least limit of a group and of those above it, up to the mount itself.
double limit_of_all(fs::path const& mount, fs::path const& group) {
  double least = limit_of(mount);
  fs::path at = mount;
  for (fs::path const& part : group.relative_path()) {
    at /= part;
    least = std::min(least, limit_of(at));
  }
  return least;
}

}  // namespace

std::optional<int> processor_quota(fs::path const& groups, fs::path const& mount) {
  std::ifstream list(groups);
  double least = HUGE_VAL;
  // Each line is "number:controllers:path"; the controllers of version 2 are empty.
  for (std::string line; std::getline(list, line);) {
    std::istringstream fields(line);
    std::string number, controllers, path;
    std::getline(fields, number, ':');
    std::getline(fields, controllers, ':');
    std::getline(fields, path);
    bool const for_processors = ("," + controllers + ",").find(",cpu,") != std::string::npos;
    if (controllers.empty()) least = std::min(least, limit_of_all(mount, path));
    if (for_processors)
      least = std::min({least, limit_of_all(mount / controllers, path), limit_of_all(mount / "cpu", path)});
  }
  if (!(least < 1e6)) return std::nullopt;
  return std::max(1, static_cast<int>(std::ceil(least)));
}

}  // namespace piola::exec_host
