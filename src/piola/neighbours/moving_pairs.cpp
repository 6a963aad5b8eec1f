// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/moving_pairs.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

struct Box {
  std::array<double, 3> low{}, high{}, mean{};
};

Box box_of(double const* x, std::ptrdiff_t stride, Index particles, std::size_t dimension) {
  Box box;
  for (std::size_t c = 0; c < dimension; ++c) {
    double low = x[c], high = x[c], sum = 0;
    for (Index i = 0; i < particles; ++i) {
      double const value = x[i * stride + static_cast<std::ptrdiff_t>(c)];
      low = std::min(low, value);
      high = std::max(high, value);
      sum += value;
    }
    box.low[c] = low;
    box.high[c] = high;
    box.mean[c] = sum / particles;
  }
  return box;
}

/// Cells along each axis; where the box would need far more cells than there are particles, its longest sides are cut
/// to a part around the mean position, and what lies outside falls into the cells at the border.
std::array<Index, 3> fit(Box& box, Index particles, std::size_t dimension, double cell) {
  double const most = 8.0 * particles + 1e5;
  std::array<double, 3> n{1, 1, 1};
  for (std::size_t c = 0; c < dimension; ++c) n[c] = std::floor((box.high[c] - box.low[c]) / cell) + 1;
  while (n[0] * n[1] * n[2] > most) {
    auto const longest = static_cast<std::size_t>(std::max_element(n.begin(), n.end()) - n.begin());
    n[longest] = std::ceil(n[longest] / 2);
    box.low[longest] = std::max(box.low[longest], box.mean[longest] - 0.5 * n[longest] * cell);
    box.low[longest] = std::min(box.low[longest], box.high[longest] - n[longest] * cell);
  }
  return {static_cast<Index>(n[0]), static_cast<Index>(n[1]), static_cast<Index>(n[2])};
}

}  // namespace

void MovingGrid::sort(double const* x, std::ptrdiff_t stride, Index particles, int dimension, double cell) {
  auto const D = static_cast<std::size_t>(dimension);
  auto const n = static_cast<std::size_t>(particles);
  if (particles == 0) return;
  Box box = box_of(x, stride, particles, D);
  std::array<Index, 3> const inner = fit(box, particles, D, cell);
  double extent = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    count_[c] = inner[c] + (c < D ? 2 : 0);
    if (c < D) extent = std::max({extent, box.high[c] - box.low[c], std::abs(box.low[c] - box.mean[c])});
  }
  slack_ = 4 * 6e-8 * (extent / cell + 1);
  key_.resize(n);
  begin_.assign(
      static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) * static_cast<std::size_t>(count_[2]) +
          1,
      0);
  for (Index i = 0; i < particles; ++i) {
    std::array<Index, 3> at{};
    for (std::size_t c = 0; c < D; ++c) {
      double const place = (x[i * stride + static_cast<std::ptrdiff_t>(c)] - box.low[c]) / cell;
      at[c] = 1 + static_cast<Index>(std::clamp(place, 0.0, static_cast<double>(inner[c] - 1)));
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
      place_[c][static_cast<std::size_t>(to)] =
          static_cast<float>((x[i * stride + static_cast<std::ptrdiff_t>(c)] - box.low[c]) / cell);
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
