// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <array>
#include <cstdint>
#include <vector>

namespace piola {

/// Points sorted into cubic cells (counting sort): all points within `cell` of a place lie in its 3 x 3 x 3 cells.
class CellGrid {
 public:
  /// points [m]; cell: edge of a cell [m], at least the search radius.
  CellGrid(std::vector<std::array<double, 3>> const& points, double cell);

  /// f(index) for every point in the cells around x, in an order that depends on the points alone.
  template <class F>
  void visit(std::array<double, 3> const& x, F const& f) const {
    std::array<std::int64_t, 3> const c = cell_of(x);
    for (std::int64_t k = lower(c[2]); k <= upper(c[2], 2); ++k)
      for (std::int64_t j = lower(c[1]); j <= upper(c[1], 1); ++j)
        for (std::int64_t i = lower(c[0]); i <= upper(c[0], 0); ++i) {
          auto const cell = static_cast<std::size_t>((k * count_[1] + j) * count_[0] + i);
          for (std::int64_t p = begin_[cell]; p < begin_[cell + 1]; ++p) f(point_[static_cast<std::size_t>(p)]);
        }
  }

 private:
  std::array<std::int64_t, 3> cell_of(std::array<double, 3> const& x) const;
  static std::int64_t lower(std::int64_t c) { return c > 0 ? c - 1 : 0; }
  std::int64_t upper(std::int64_t c, std::size_t axis) const { return c + 1 < count_[axis] ? c + 1 : count_[axis] - 1; }

  std::array<double, 3> origin_{};
  double cell_;
  std::array<std::int64_t, 3> count_{1, 1, 1};
  std::vector<std::int64_t> begin_;
  std::vector<Index> point_;
};

}  // namespace piola
