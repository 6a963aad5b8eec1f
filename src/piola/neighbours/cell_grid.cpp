// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>

namespace piola {

CellGrid::CellGrid(std::vector<std::array<double, 3>> const& points, double cell) : cell_(cell) {
  std::array<double, 3> high{};
  if (!points.empty()) origin_ = high = points.front();
  for (auto const& p : points)
    for (std::size_t c = 0; c < 3; ++c) {
      origin_[c] = std::min(origin_[c], p[c]);
      high[c] = std::max(high[c], p[c]);
    }
  // A sparse set must not make more cells than a few per point.
  auto const most = static_cast<double>(4 * points.size() + 64);
  for (;;) {
    double total = 1;
    for (std::size_t c = 0; c < 3; ++c) total *= std::floor((high[c] - origin_[c]) / cell_) + 1;
    if (total <= most) break;
    cell_ *= 2;
  }
  for (std::size_t c = 0; c < 3; ++c) count_[c] = static_cast<std::int64_t>((high[c] - origin_[c]) / cell_) + 1;
  auto const cells = static_cast<std::size_t>(count_[0] * count_[1] * count_[2]);
  begin_.assign(cells + 1, 0);
  std::vector<std::size_t> home(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    auto const c = cell_of(points[p]);
    home[p] = static_cast<std::size_t>((c[2] * count_[1] + c[1]) * count_[0] + c[0]);
    ++begin_[home[p] + 1];
  }
  for (std::size_t k = 0; k < cells; ++k) begin_[k + 1] += begin_[k];
  point_.resize(points.size());
  auto next = begin_;
  for (std::size_t p = 0; p < points.size(); ++p)
    point_[static_cast<std::size_t>(next[home[p]]++)] = static_cast<Index>(p);
}

std::array<std::int64_t, 3> CellGrid::cell_of(std::array<double, 3> const& x) const {
  std::array<std::int64_t, 3> c{};
  for (std::size_t k = 0; k < 3; ++k)
    c[k] =
        std::clamp(static_cast<std::int64_t>(std::floor((x[k] - origin_[k]) / cell_)), std::int64_t{0}, count_[k] - 1);
  return c;
}

}  // namespace piola
