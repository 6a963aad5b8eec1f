// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <optional>

namespace piola::exec_host {

/// Returns the number of processors that the control group of this process may use (cpu.max of cgroup v2,
/// cpu.cfs_quota_us by cpu.cfs_period_us of v1), rounded up; the least of the group and all groups above it. Nothing if
/// there is no limit or it cannot be read. groups: list of the groups of the process; mount: mount point of control
/// groups.
std::optional<int> processor_quota(std::filesystem::path const& groups = "/proc/self/cgroup",
                                   std::filesystem::path const& mount = "/sys/fs/cgroup");

}  // namespace piola::exec_host
