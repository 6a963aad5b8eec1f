// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/halo_count.hpp"
#include "piola/base/contracts.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>

namespace piola {
namespace {

double square_of_distance(std::array<double, 3> const& a, std::array<double, 3> const& b) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

}  // namespace

HaloCounts count_halos(std::vector<std::array<double, 3>> const& X, std::span<int const> owner, int ranks,
                       double reach) {
  PIOLA_EXPECTS(owner.size() == X.size() && ranks > 0 && reach > 0);
  HaloCounts reads(static_cast<std::size_t>(ranks));
  // Kernels vanish at the very edge, where lattices have neighbours: they read none there.
  constexpr double edge = 1 - 1e-9;
  double const square = reach * reach * edge * edge;
  CellGrid const grid(X, reach);
  std::vector<int> readers;
  for (std::size_t b = 0; b < X.size(); ++b) {
    readers.clear();
    grid.visit(X[b], [&](Index i) {
      auto const a = static_cast<std::size_t>(i);
      if (owner[a] == owner[b] || std::find(readers.begin(), readers.end(), owner[a]) != readers.end()) return;
      if (square_of_distance(X[a], X[b]) < square) readers.push_back(owner[a]);
    });
    for (int const r : readers) reads[static_cast<std::size_t>(r)][owner[b]] += 1;
  }
  return reads;
}

}  // namespace piola
