// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace piola {

/// Points sorted into cubic cells (counting sort): all points within `cell` of a place lie in its 3 x 3 x 3 cells.
/// Memory and time are bounded by the number of points, wherever they are: cells of a box that fits them closely are
/// stored one after the other, those of sparse points in a hash table. A point without a finite position is not a
/// neighbour of any place.
class CellGrid {
 public:
  /// points [m]; cell: edge of a cell [m], at least the search radius.
  CellGrid(std::vector<std::array<double, 3>> const& points, double cell);

  /// f(index) for every point in the cells around x, in an order that depends on the points alone.
  template <class F>
  void visit(std::array<double, 3> const& x, F const& f) const {
    Cell const c = cell_of(x);
    if (c == lost) return;
    for (std::int64_t k = lower(c[2], 2); k <= upper(c[2], 2); ++k)
      for (std::int64_t j = lower(c[1], 1); j <= upper(c[1], 1); ++j)
        for (std::int64_t i = lower(c[0], 0); i <= upper(c[0], 0); ++i) {
          std::size_t const place = place_of({i, j, k});
          for (std::int64_t p = begin_[place]; p < begin_[place + 1]; ++p) {
            // Several cells may have the same place in the hash table.
            if (!cell_at_.empty() && cell_at_[static_cast<std::size_t>(p)] != Cell{i, j, k}) continue;
            f(point_[static_cast<std::size_t>(p)]);
          }
        }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  /// Cell of a point without a finite position.
  static constexpr Cell lost{std::numeric_limits<std::int64_t>::min(), 0, 0};

  void find_shape(std::vector<std::array<double, 3>> const& points);
  void hash(std::vector<std::array<double, 3>> const& points);
  Cell cell_of(std::array<double, 3> const& x) const;
  std::size_t place_of(Cell const& cell) const;
  std::int64_t lower(std::int64_t c, std::size_t axis) const { return c > first_[axis] ? c - 1 : c; }
  std::int64_t upper(std::int64_t c, std::size_t axis) const { return c < last_[axis] ? c + 1 : c; }

  std::array<double, 3> origin_{};  ///< of cell (0, 0, 0) [m]
  double cell_;
  Cell first_{}, last_{};            ///< along each axis
  std::size_t places_ = 1;           ///< cells, or places of the hash table
  std::vector<std::int64_t> begin_;  ///< first point of each place, one more at the end
  std::vector<Index> point_;
  std::vector<Cell> cell_at_;  ///< hash table: the cell of each entry of point_
};

}  // namespace piola
