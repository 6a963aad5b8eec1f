// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace piola {

using HaloCounts = std::vector<std::map<int, std::int64_t>>;

/// Counts ghosts for a given partition without MPI: reads[r][s] is the number of particles of rank s within `reach` [m]
/// of a particle of rank r. X: positions [m]; owner: rank of each particle, 0 to ranks - 1. For estimates and to
/// compare partitions. Cost: proportional to the number of particles and neighbours.
HaloCounts count_halos(std::vector<std::array<double, 3>> const& X, std::span<int const> owner, int ranks,
                       double reach);

}  // namespace piola
