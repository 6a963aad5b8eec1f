// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/modes.hpp"
#include <algorithm>
#include <cmath>

namespace piola {

double pseudo_random(std::uint64_t k) {
  k = (k + 0x9e3779b97f4a7c15ULL) * 0xbf58476d1ce4e5b9ULL;
  k = (k ^ (k >> 29)) * 0x94d049bb133111ebULL;
  return static_cast<double>((k ^ (k >> 32)) & 0xffffff) / 0x1000000 - 0.5;
}

double largest_of(std::vector<double> const& u) {
  double most = 0;
  for (double const value : u) most = std::max(most, std::abs(value));
  return most;
}

void refresh_mode(std::vector<double>& mode) {
  constexpr double fresh = 0.05;
  double const most = largest_of(mode);
  for (std::size_t k = 0; k < mode.size(); ++k)
    mode[k] = most > 0 ? mode[k] / most + fresh * pseudo_random(k) : pseudo_random(k);
}

}  // namespace piola
