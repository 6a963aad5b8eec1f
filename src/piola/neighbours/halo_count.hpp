// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace piola {

using HaloCounts = std::vector<std::map<int, std::int64_t>>;

/// What ranks would read of each other, without there being any: reads[r][s] particles of rank s have one of rank r
/// within `reach` [m]. X: positions [m]; owner: the rank of each, 0 to ranks - 1. For estimates, and to compare cuts.
/// Time by the number of particles and of their neighbours.
HaloCounts count_halos(std::vector<std::array<double, 3>> const& X, std::span<int const> owner, int ranks,
                       double reach);

}  // namespace piola
