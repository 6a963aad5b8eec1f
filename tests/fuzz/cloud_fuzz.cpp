// SPDX-License-Identifier: Apache-2.0
// Whatever bytes a table of points holds, the reader says what is wrong with it or returns points that can be computed
// with. The first line may hold what a case says about it: "#volume 2", "#unit 0.001", "#body left".
#include "piola/setup/cloud_file.hpp"
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

using namespace piola;

CloudOptions options_of(std::string_view text) {
  CloudOptions options;
  std::string const line(text.substr(0, text.find('\n')));
  if (line.starts_with("#volume ")) options.total_volume = std::strtod(line.c_str() + 8, nullptr);
  if (line.starts_with("#unit ")) options.length_unit = std::strtod(line.c_str() + 6, nullptr);
  if (line.starts_with("#body ")) options.body = line.substr(6);
  return options;
}

bool can_be_computed_with(PointCloud const& cloud) {
  std::size_t const n = cloud.X.size();
  bool good = n > static_cast<std::size_t>(cloud.dimension) && cloud.volume.size() == n &&
              cloud.kernel_volume.size() == n && cloud.spacing > 0 && std::isfinite(cloud.spacing);
  for (std::size_t i = 0; good && i < n; ++i) good = cloud.volume[i] > 0 && std::isfinite(cloud.X[i][0]);
  return good;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string_view const text(reinterpret_cast<char const*>(data), size);
  std::vector<std::string> problems;
  PointCloud const cloud = read_cloud_text(text, "fuzz.csv", options_of(text), problems);
  if (problems.empty() && !can_be_computed_with(cloud)) std::abort();
  return 0;
}
