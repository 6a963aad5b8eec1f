// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/moving_pairs.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola {
namespace {

/// Places further outside of the box than this are there [cells]: single precision has enough digits up to it.
constexpr double farthest = 1e5;

/// So far from the origin places are counted from a multiple of it [cells].
constexpr double far_block = 65536;

/// Cells [low, low + count) along an axis. Whole numbers; what lies outside falls into the cells at the border.
struct CellSpan {
  double low = 0, count = 1;
};

/// Where a coordinate is [cells].
double cells_from(double x, double origin, double cell) { return (x - origin) / cell; }

/// All finite coordinates along an axis.
CellSpan span_of_cells(double const* x, std::ptrdiff_t stride, Index particles, double origin, double cell) {
  constexpr double most = std::numeric_limits<double>::max();
  double low = most, high = -most;
  for (Index i = 0; i < particles; ++i) {
    double const value = x[i * stride];
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) return {};
  auto const bound = [](double place) { return std::clamp(std::floor(place), -1e300, 1e300); };
  double const first = bound(cells_from(low, origin, cell));
  return {first, std::min(bound(cells_from(high, origin, cell)) - first, 1e300) + 1};
}

/// Half of the finite coordinates along an axis lie below it: few particles far away do not move it.
double median(double const* x, std::ptrdiff_t stride, Index particles) {
  std::vector<double> all;
  for (Index i = 0; i < particles; ++i)
    if (std::isfinite(x[i * stride])) all.push_back(x[i * stride]);
  auto const middle = all.begin() + std::ssize(all) / 2;
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

/// Where there would be far more cells than particles, the longest axes are cut to a part around the median position.
std::array<CellSpan, 3> fit(double const* x, std::ptrdiff_t stride, Index particles, std::size_t dimension,
                            std::array<double, 3> const& origin, double cell) {
  double const most = 8.0 * particles + 1e5;
  std::array<CellSpan, 3> cells;
  for (std::size_t c = 0; c < dimension; ++c) cells[c] = span_of_cells(x + c, stride, particles, origin[c], cell);
  std::array<CellSpan, 3> const all = cells;
  while (cells[0].count * cells[1].count * cells[2].count > most) {
    CellSpan& longest = *std::max_element(cells.begin(), cells.end(),
                                          [](CellSpan const& a, CellSpan const& b) { return a.count < b.count; });
    longest.count = std::ceil(longest.count / 2);
  }
  for (std::size_t c = 0; c < dimension; ++c) {
    if (cells[c].count == all[c].count) continue;
    double const middle = std::floor(cells_from(median(x + c, stride, particles), origin[c], cell));
    cells[c].low = std::clamp(middle - std::floor(0.5 * cells[c].count), all[c].low,
                              std::max(all[c].low, all[c].low + all[c].count - cells[c].count));
  }
  return cells;
}

}  // namespace

void MovingGrid::sort(double const* x, std::ptrdiff_t stride, Index particles, int dimension, double cell,
                      std::array<double, 3> const& origin, Index const* order) {
  auto const D = static_cast<std::size_t>(dimension);
  auto const n = static_cast<std::size_t>(particles);
  if (particles == 0) return;
  std::array<CellSpan, 3> const cells = fit(x, stride, particles, D, origin, cell);
  std::array<double, 3> base{};  // of places in single precision
  for (std::size_t c = 0; c < 3; ++c) {
    count_[c] = static_cast<Index>(cells[c].count) + (c < D ? 2 : 0);
    base[c] = far_block * std::round(cells[c].low / far_block);
    place_[c].resize(n + 32);
  }
  key_.resize(n);
  begin_.assign(
      static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) * static_cast<std::size_t>(count_[2]) +
          1,
      0);
  for (Index i = 0; i < particles; ++i) {
    std::array<Index, 3> at{};
    for (std::size_t c = 0; c < D; ++c) {
      double const inner =
          std::floor(cells_from(x[i * stride + static_cast<std::ptrdiff_t>(c)], origin[c], cell)) - cells[c].low;
      // Written so that what is not a number falls into the first cell.
      at[c] = 1 + (inner > 0 ? static_cast<Index>(std::min(inner, cells[c].count - 1)) : 0);
    }
    Index const key = (at[2] * count_[1] + at[1]) * count_[0] + at[0];
    key_[static_cast<std::size_t>(i)] = key;
    ++begin_[static_cast<std::size_t>(key) + 1];
  }
  for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  slot_.resize(n);
  sorted_.resize(n);
  cell_.resize(n);
  double extent = 0;  // the largest number in place_
  for (Index k = 0; k < particles; ++k) {
    Index const i = order != nullptr ? order[k] : k;
    Index const key = key_[static_cast<std::size_t>(i)], to = begin_[static_cast<std::size_t>(key)]++;
    slot_[static_cast<std::size_t>(to)] = i;
    sorted_[static_cast<std::size_t>(i)] = to;
    cell_[static_cast<std::size_t>(to)] = key;
    for (std::size_t c = 0; c < D; ++c) {
      double const where = cells_from(x[i * stride + static_cast<std::ptrdiff_t>(c)], origin[c], cell),
                   kept =
                       std::clamp(where, cells[c].low - farthest, cells[c].low + cells[c].count + farthest) - base[c];
      place_[c][static_cast<std::size_t>(to)] = static_cast<float>(kept);
      if (std::fabs(kept) > extent) extent = std::fabs(kept);
    }
  }
  slack_ = 4 * 6e-8 * (extent + 1);
  // The scatter has moved every begin to its end.
  std::move_backward(begin_.begin(), begin_.end() - 1, begin_.end());
  begin_[0] = 0;
}

std::size_t MovingGrid::bytes() const {
  return sizeof(Index) * (slot_.size() + sorted_.size() + cell_.size() + begin_.size() + key_.size()) +
         sizeof(float) * 3 * place_[0].size();
}

}  // namespace piola
