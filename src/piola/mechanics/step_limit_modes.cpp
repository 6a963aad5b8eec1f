// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/step_limit_modes.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <cmath>
#include <vector>

namespace piola {

double pseudo_random(std::uint64_t k) {
  k = (k + 0x9e3779b97f4a7c15ULL) * 0xbf58476d1ce4e5b9ULL;
  k = (k ^ (k >> 29)) * 0x94d049bb133111ebULL;
  return static_cast<double>((k ^ (k >> 32)) & 0xffffff) / 0x1000000 - 0.5;
}

double largest_of(std::span<double const> u) {
  constexpr std::size_t part = 1 << 16;
  std::vector<double> most((u.size() + part - 1) / part, 0);
  exec_host::parallel_for_chunks(static_cast<Index>(most.size()), static_cast<Index>(u.size() / 3), [&](Index k) {
    auto const first = static_cast<std::size_t>(k) * part;
    double& here = most[static_cast<std::size_t>(k)];
    for (std::size_t i = first; i < std::min(first + part, u.size()); ++i) here = std::max(here, std::abs(u[i]));
  });
  return most.empty() ? 0 : *std::max_element(most.begin(), most.end());
}

double refreshed(double value, double most, std::uint64_t k) {
  constexpr double fresh = 0.05;
  return most > 0 ? value / most + fresh * pseudo_random(k) : pseudo_random(k);
}

}  // namespace piola
