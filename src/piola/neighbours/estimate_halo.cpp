// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/estimate_halo.hpp"
#include "piola/base/contracts.hpp"
#include "piola/neighbours/cell_list.hpp"
#include <algorithm>

namespace piola {
namespace {

double square_of_distance(std::array<double, 3> const& a, std::array<double, 3> const& b) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

/// Cells of the edge of the reach: whose the particles of each are.
class OwnedCells {
 public:
  OwnedCells(std::vector<std::array<double, 3>> const& X, std::span<int const> owner, double reach) {
    auto const n = static_cast<Index>(X.size());
    grid_.find_cells(X.front().data(), 3, n, 3, reach, X.front());
    grid_.sort({n});
    owner_.assign(static_cast<std::size_t>(grid_.cell_count()), nobody);
    for (std::size_t k = 0; k < X.size(); ++k) {
      int& here = owner_[static_cast<std::size_t>(grid_.cells()[k])];
      int const own = owner[static_cast<std::size_t>(grid_.slots()[k])];
      here = here == nobody || here == own ? own : several;
    }
  }
  Index count() const { return grid_.cell_count(); }
  /// f(particle) of those in a cell.
  template <class F>
  void each_in(Index cell, F const& f) const {
    for (Index k = grid_.begins()[cell]; k < grid_.begins()[cell + 1]; ++k)
      f(static_cast<std::size_t>(grid_.slots()[k]));
  }
  bool is_empty(Index cell) const { return owner_[static_cast<std::size_t>(cell)] == nobody; }
  /// Lists the occupied cells among `cell` and its neighbours that another rank owns; all occupied ones if `cell`
  /// itself has several owners.
  void others_around(Index cell, std::vector<Index>& others) const {
    others.clear();
    int const own = owner_[static_cast<std::size_t>(cell)];
    Index const row = grid_.shape()[0], rows = grid_.shape()[1];
    for (Index dz = -1; dz <= 1; ++dz)
      for (Index dy = -1; dy <= 1; ++dy)
        for (Index dx = -1; dx <= 1; ++dx) {
          Index const other = cell + (dz * rows + dy) * row + dx;
          int const whose = owner_[static_cast<std::size_t>(other)];
          if (whose != nobody && (whose != own || own == several)) others.push_back(other);
        }
  }

 private:
  static constexpr int nobody = -1, several = -2;
  CellList grid_;
  std::vector<int> owner_;
};

}  // namespace

HaloCounts count_halos(std::vector<std::array<double, 3>> const& X, std::span<int const> owner, int ranks,
                       double reach) {
  PIOLA_EXPECTS(owner.size() == X.size() && ranks > 0 && reach > 0);
  HaloCounts reads(static_cast<std::size_t>(ranks));
  // Kernels vanish at the very edge, where lattices have neighbours: they read none there.
  constexpr double edge = 1 - 1e-9;
  double const square = reach * reach * edge * edge;
  if (X.empty()) return reads;
  OwnedCells const cells(X, owner, reach);
  std::vector<Index> others;
  std::vector<int> readers;
  for (Index cell = 0; cell < cells.count(); ++cell) {
    if (cells.is_empty(cell)) continue;
    cells.others_around(cell, others);
    if (others.empty()) continue;  // nearly all of them, of few ranks
    cells.each_in(cell, [&](std::size_t b) {
      readers.clear();
      for (Index const other : others)
        cells.each_in(other, [&](std::size_t a) {
          if (owner[a] == owner[b] || std::find(readers.begin(), readers.end(), owner[a]) != readers.end()) return;
          if (square_of_distance(X[a], X[b]) < square) readers.push_back(owner[a]);
        });
      for (int const r : readers) reads[static_cast<std::size_t>(r)][owner[b]] += 1;
    });
  }
  return reads;
}

}  // namespace piola
