// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/moving_pairs.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola {
namespace {

/// Places further outside of the box than this are there [cells]: single precision has enough digits up to it.
constexpr double farthest = 1e5;

struct Box {
  std::array<double, 3> low{}, high{};
};

/// Around all coordinates that are finite.
Box box_of(double const* x, std::ptrdiff_t stride, Index particles, std::size_t dimension) {
  Box box;
  for (std::size_t c = 0; c < dimension; ++c) {
    constexpr double most = std::numeric_limits<double>::max();
    double low = most, high = -most;
    for (Index i = 0; i < particles; ++i) {
      double const value = x[i * stride + static_cast<std::ptrdiff_t>(c)];
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    box.low[c] = low <= high ? low : 0;
    box.high[c] = low <= high ? high : 0;
  }
  return box;
}

/// Half of the finite coordinates along an axis lie below it: few particles far away do not move it.
double median(double const* x, std::ptrdiff_t stride, Index particles, std::size_t axis) {
  std::vector<double> all;
  for (Index i = 0; i < particles; ++i) {
    double const value = x[i * stride + static_cast<std::ptrdiff_t>(axis)];
    if (std::isfinite(value)) all.push_back(value);
  }
  auto const middle = all.begin() + std::ssize(all) / 2;
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

/// Cells along each axis; where the box would need far more cells than there are particles, its longest sides are cut
/// to a part around the median position, and what lies outside falls into the cells at the border.
std::array<Index, 3> fit(Box& box, double const* x, std::ptrdiff_t stride, Index particles, std::size_t dimension,
                         double cell) {
  double const most = 8.0 * particles + 1e5;
  std::array<double, 3> n{1, 1, 1};
  for (std::size_t c = 0; c < dimension; ++c) n[c] = std::floor(std::min((box.high[c] - box.low[c]) / cell, 1e300)) + 1;
  std::array<bool, 3> cut{};
  while (n[0] * n[1] * n[2] > most) {
    auto const longest = static_cast<std::size_t>(std::max_element(n.begin(), n.end()) - n.begin());
    n[longest] = std::ceil(n[longest] / 2);
    cut[longest] = true;
  }
  for (std::size_t c = 0; c < dimension; ++c) {
    if (!cut[c]) continue;
    double const middle = median(x, stride, particles, c), length = n[c] * cell;
    box.low[c] = std::clamp(middle - 0.5 * length, box.low[c], std::max(box.low[c], box.high[c] - length));
    box.high[c] = box.low[c] + length;
  }
  return {static_cast<Index>(n[0]), static_cast<Index>(n[1]), static_cast<Index>(n[2])};
}

}  // namespace

void MovingGrid::sort(double const* x, std::ptrdiff_t stride, Index particles, int dimension, double cell) {
  auto const D = static_cast<std::size_t>(dimension);
  auto const n = static_cast<std::size_t>(particles);
  if (particles == 0) return;
  Box box = box_of(x, stride, particles, D);
  Box const all = box;
  std::array<Index, 3> const inner = fit(box, x, stride, particles, D, cell);
  double extent = 0;  // the largest number in place_
  std::array<double, 3> most{};
  for (std::size_t c = 0; c < 3; ++c) {
    count_[c] = inner[c] + (c < D ? 2 : 0);
    most[c] = inner[c] + farthest;
    extent = std::max({extent, std::min((all.high[c] - box.low[c]) / cell, most[c]),
                       std::min((box.low[c] - all.low[c]) / cell, farthest)});
  }
  slack_ = 4 * 6e-8 * (extent + 1);
  key_.resize(n);
  begin_.assign(
      static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) * static_cast<std::size_t>(count_[2]) +
          1,
      0);
  for (Index i = 0; i < particles; ++i) {
    std::array<Index, 3> at{};
    for (std::size_t c = 0; c < D; ++c) {
      double const place = (x[i * stride + static_cast<std::ptrdiff_t>(c)] - box.low[c]) / cell;
      // Written so that what is not a number falls into the first cell.
      at[c] = 1 + (place > 0 ? static_cast<Index>(std::min(place, static_cast<double>(inner[c] - 1))) : 0);
    }
    Index const key = (at[2] * count_[1] + at[1]) * count_[0] + at[0];
    key_[static_cast<std::size_t>(i)] = key;
    ++begin_[static_cast<std::size_t>(key) + 1];
  }
  for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  slot_.resize(n);
  sorted_.resize(n);
  cell_.resize(n);
  for (std::size_t c = 0; c < 3; ++c) place_[c].resize(n + 32);
  for (Index i = 0; i < particles; ++i) {
    Index const key = key_[static_cast<std::size_t>(i)], to = begin_[static_cast<std::size_t>(key)]++;
    slot_[static_cast<std::size_t>(to)] = i;
    sorted_[static_cast<std::size_t>(i)] = to;
    cell_[static_cast<std::size_t>(to)] = key;
    for (std::size_t c = 0; c < D; ++c)
      place_[c][static_cast<std::size_t>(to)] = static_cast<float>(
          std::clamp((x[i * stride + static_cast<std::ptrdiff_t>(c)] - box.low[c]) / cell, -farthest, most[c]));
  }
  // The scatter has moved every begin to its end.
  std::move_backward(begin_.begin(), begin_.end() - 1, begin_.end());
  begin_[0] = 0;
}

std::size_t MovingGrid::bytes() const {
  return sizeof(Index) * (slot_.size() + sorted_.size() + cell_.size() + begin_.size() + key_.size()) +
         sizeof(float) * 3 * place_[0].size();
}

}  // namespace piola
