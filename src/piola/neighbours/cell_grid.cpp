// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/cell_grid.hpp"
#include "piola/base/contracts.hpp"
#include "piola/math/hash.hpp"
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace piola {
namespace {

/// Cells further away than this from the origin are that one: whole numbers of a double are exact up to 2^53.
constexpr double farthest_cell = 0x1p52;

bool is_finite(std::array<double, 3> const& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

}  // namespace

CellGrid::CellGrid(std::vector<std::array<double, 3>> const& points, double cell)
    : cell_(cell > 0 ? cell : std::numeric_limits<double>::min()) {
  PIOLA_EXPECTS(points.size() < static_cast<std::size_t>(std::numeric_limits<Index>::max()));
  find_shape(points);
  std::vector<Cell> home(points.size());
  begin_.assign(places_ + 1, 0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    home[p] = cell_of(points[p]);
    if (home[p] != lost) ++begin_[place_of(home[p]) + 1];
  }
  for (std::size_t k = 0; k < places_; ++k) begin_[k + 1] += begin_[k];
  auto next = begin_;
  point_.resize(static_cast<std::size_t>(begin_.back()));
  bool const hashed = !cell_at_.empty();
  cell_at_.resize(hashed ? point_.size() : 0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (home[p] == lost) continue;
    auto const to = static_cast<std::size_t>(next[place_of(home[p])]++);
    point_[to] = static_cast<Index>(p);
    if (hashed) cell_at_[to] = home[p];
  }
  PIOLA_ENSURES(begin_.size() == places_ + 1 && point_.size() <= points.size());
}

/// The box around all points that have a finite position, and whether its cells are few enough to be stored.
void CellGrid::find_shape(std::vector<std::array<double, 3>> const& points) {
  std::array<double, 3> high{};
  bool first = true;
  for (auto const& p : points) {
    if (!is_finite(p)) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      origin_[c] = first ? p[c] : std::min(origin_[c], p[c]);
      high[c] = first ? p[c] : std::max(high[c], p[c]);
    }
    first = false;
  }
  double total = 1;
  for (std::size_t c = 0; c < 3; ++c) {
    double const cells = std::floor((high[c] - origin_[c]) / cell_) + 1;
    last_[c] = static_cast<std::int64_t>(cells < farthest_cell ? cells : farthest_cell) - 1;
    total *= static_cast<double>(last_[c] + 1);
  }
  if (total > static_cast<double>(4 * points.size() + 64)) {
    hash(points);
  } else {
    places_ = static_cast<std::size_t>(total);
  }
}

/// Counts from the medians: there most points are, and differences to a place far away would have no digits for them.
void CellGrid::hash(std::vector<std::array<double, 3>> const& points) {
  places_ = std::bit_ceil(2 * points.size() + 1);
  cell_at_.resize(points.size());
  std::vector<double> values;
  for (std::size_t c = 0; c < 3; ++c) {
    values.clear();
    for (auto const& p : points)
      if (is_finite(p)) values.push_back(p[c]);
    auto const middle = values.begin() + std::ssize(values) / 2;
    std::nth_element(values.begin(), middle, values.end());
    origin_[c] = *middle;
    last_[c] = static_cast<std::int64_t>(farthest_cell);
    first_[c] = -last_[c];
  }
}

CellGrid::Cell CellGrid::cell_of(std::array<double, 3> const& x) const {
  if (!is_finite(x)) return lost;
  Cell cell{};
  for (std::size_t c = 0; c < 3; ++c) {
    double const at = std::floor((x[c] - origin_[c]) / cell_);
    cell[c] = static_cast<std::int64_t>(std::clamp(at, static_cast<double>(first_[c]), static_cast<double>(last_[c])));
  }
  return cell;
}

std::size_t CellGrid::place_of(Cell const& cell) const {
  if (cell_at_.empty())
    return static_cast<std::size_t>((cell[2] * (last_[1] + 1) + cell[1]) * (last_[0] + 1) + cell[0]);
  std::uint64_t hash = 0;
  for (std::int64_t const c : cell) hash = hash_mix(hash * 0x9E3779B97F4A7C15U + static_cast<std::uint64_t>(c) + 1);
  return static_cast<std::size_t>(hash) & (places_ - 1);
}

}  // namespace piola
