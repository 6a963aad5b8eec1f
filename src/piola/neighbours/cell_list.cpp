// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/cell_list.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola {
namespace {

/// Places further outside of the box than this are there [cells]: single precision has enough digits up to it.
constexpr double farthest = 1e5;

/// So far from the origin places are counted from a multiple of it [cells].
constexpr double far_block = 65536;

/// Half of the finite coordinates lie below it: few particles far away do not move it.
double median(std::vector<double> all) {
  std::erase_if(all, [](double value) { return !std::isfinite(value); });
  auto const middle = all.begin() + std::ssize(all) / 2;
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

}  // namespace

CoordinateBounds::CoordinateBounds() {
  constexpr double most = std::numeric_limits<double>::max();
  low.fill(most);
  high.fill(-most);
}

CoordinateBounds bounds_of(double const* x, std::ptrdiff_t stride, SlotList const& some, int dimension) {
  PIOLA_EXPECTS(some.count >= 0 && (x != nullptr || some.count == 0));
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  PIOLA_EXPECTS(stride >= dimension);
  constexpr Index part = 4096;
  Index const parts = (some.count + part - 1) / part;
  std::vector<CoordinateBounds> of_part(static_cast<std::size_t>(parts));
  exec_host::parallel_for_chunks(parts, some.count, [&](Index p) {
    CoordinateBounds& here = of_part[static_cast<std::size_t>(p)];
    for (Index k = p * part; k < std::min(some.count, (p + 1) * part); ++k)
      for (int c = 0; c < dimension; ++c) {
        double const value = x[some[k] * stride + c];
        if (std::isfinite(value))
          here.add(static_cast<std::size_t>(c), value, value);
        else
          here.all_finite = false;
      }
  });
  CoordinateBounds all;
  for (CoordinateBounds const& here : of_part) all.add(here);
  return all;
}

/// All finite coordinates along an axis.
CellList::Span CellList::span(CoordinateBounds const& bounds, std::size_t axis) const {
  if (bounds.low[axis] > bounds.high[axis]) return {};
  auto const bound = [](double place) { return std::clamp(std::floor(place), -1e300, 1e300); };
  double const first = bound(in_cells(bounds.low[axis], axis));
  return {first, std::min(bound(in_cells(bounds.high[axis], axis)) - first, 1e300) + 1};
}

/// Where there would be far more cells than particles, the longest axes are cut to a part around the median position.
void CellList::fit(CoordinateBounds const& bounds, Coordinates const& coordinates) {
  double const most = 8.0 * particles_ + 1e5;
  span_ = {};
  for (std::size_t c = 0; c < dimension_; ++c) span_[c] = span(bounds, c);
  std::array<Span, 3> const all = span_;
  while (span_[0].count * span_[1].count * span_[2].count > most) {
    Span& longest =
        *std::max_element(span_.begin(), span_.end(), [](Span const& a, Span const& b) { return a.count < b.count; });
    longest.count = std::ceil(longest.count / 2);
  }
  for (std::size_t c = 0; c < dimension_; ++c) {
    if (span_[c].count == all[c].count) continue;
    double const middle = std::floor(in_cells(median(coordinates(c)), c));
    span_[c].low = std::clamp(middle - std::floor(0.5 * span_[c].count), all[c].low,
                              std::max(all[c].low, all[c].low + all[c].count - span_[c].count));
  }
}

/// Coordinate in units of a cell, as in place_.
double CellList::kept(double x, std::size_t axis) const {
  Span const& s = span_[axis];
  return std::clamp(in_cells(x, axis), s.low - farthest, s.low + s.count + farthest) - base_[axis];
}

void CellList::lay(CoordinateBounds const& all, Index particles, int dimension, double cell,
                   std::array<double, 3> const& origin, Coordinates const& coordinates) {
  PIOLA_EXPECTS(particles >= 0);
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  PIOLA_EXPECTS(coordinates != nullptr);
  particles_ = particles;
  dimension_ = static_cast<std::size_t>(dimension);
  cell_edge_ = cell;
  origin_ = origin;
  fit(all, coordinates);
  double extent = 0;  // largest coordinate in cell units, independent of which particles are local
  for (std::size_t c = 0; c < 3; ++c) {
    count_[c] = static_cast<Index>(span_[c].count) + (c < dimension_ ? 2 : 0);
    base_[c] = far_block * std::round(span_[c].low / far_block);
    if (c < dimension_ && all.low[c] <= all.high[c])
      extent = std::max({extent, std::fabs(kept(all.low[c], c)), std::fabs(kept(all.high[c], c))});
  }
  slack_ = 4 * 6e-8 * (extent + 1);
  if (static_cast<Index>(key_.size()) == particles) return;
  key_ = LazyZeroArray<Index>(static_cast<std::size_t>(particles));
  sorted_ = LazyZeroArray<Index>(static_cast<std::size_t>(particles));
}

Index CellList::index_along(double x, std::size_t axis) const {
  double const inner = std::floor(in_cells(x, axis)) - span_[axis].low;
  // Written so that what is not a number falls into the first cell.
  return 1 + (inner > 0 ? static_cast<Index>(std::min(inner, span_[axis].count - 1)) : 0);
}

std::array<Index, 3> CellList::indices_of(std::array<double, 3> const& x) const {
  std::array<Index, 3> at{};
  for (std::size_t c = 0; c < dimension_; ++c) at[c] = index_along(x[c], c);
  return at;
}

std::array<Index, 3> CellList::indices_of(Index cell) const {
  return {cell % count_[0], cell / count_[0] % count_[1], cell / count_[0] / count_[1]};
}

void CellList::find_cells(double const* x, std::ptrdiff_t stride, SlotList const& some) {
  PIOLA_EXPECTS(some.count >= 0 && some.count <= particles_);
  PIOLA_EXPECTS(x != nullptr || some.count == 0);
  PIOLA_EXPECTS(stride >= static_cast<std::ptrdiff_t>(dimension_));
  x_ = x;
  stride_ = stride;
  exec_host::parallel_for(some.count, [&](Index k) {
    Index const i = some[k];
    std::array<Index, 3> at{};
    for (std::size_t c = 0; c < dimension_; ++c)
      at[c] = index_along(x_[i * stride_ + static_cast<std::ptrdiff_t>(c)], c);
    key_[static_cast<std::size_t>(i)] = (at[2] * count_[1] + at[1]) * count_[0] + at[0];
  });
}

void CellList::find_cells(double const* x, std::ptrdiff_t stride, Index particles, int dimension, double cell,
                          std::array<double, 3> const& origin) {
  SlotList const all{particles};
  lay(bounds_of(x, stride, all, dimension), particles, dimension, cell, origin, [&](std::size_t axis) {
    std::vector<double> along;
    for (Index i = 0; i < particles; ++i) along.push_back(x[i * stride + static_cast<std::ptrdiff_t>(axis)]);
    return along;
  });
  find_cells(x, stride, all);
}

void CellList::sort(SlotList const& some) {
  PIOLA_EXPECTS(some.count >= 0 && some.count <= particles_);
  PIOLA_EXPECTS(x_ != nullptr || some.count == 0);
  begin_.assign(static_cast<std::size_t>(cell_count()) + 1, 0);
  for (Index k = 0; k < some.count; ++k)
    ++begin_[static_cast<std::size_t>(key_[static_cast<std::size_t>(some[k])]) + 1];
  for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  slot_.resize(static_cast<std::size_t>(some.count));
  cell_.resize(static_cast<std::size_t>(some.count));
  for (auto& along : place_) along.resize(static_cast<std::size_t>(some.count) + 32);
  for (Index k = 0; k < some.count; ++k) {
    auto const cell = static_cast<std::size_t>(key_[static_cast<std::size_t>(some[k])]);
    slot_[static_cast<std::size_t>(begin_[cell]++)] = some[k];
  }
  // The scatter has moved every begin to its end.
  std::move_backward(begin_.begin(), begin_.end() - 1, begin_.end());
  begin_[0] = 0;
  exec_host::parallel_for(some.count, [&](Index k) {
    auto const to = static_cast<std::size_t>(k);
    Index const i = slot_[to];
    sorted_[static_cast<std::size_t>(i)] = k;
    cell_[to] = key_[static_cast<std::size_t>(i)];
    for (std::size_t c = 0; c < dimension_; ++c)
      place_[c][to] = static_cast<float>(kept(x_[i * stride_ + static_cast<std::ptrdiff_t>(c)], c));
  });
}

std::array<double, 3> CellList::where(Index slot) const {
  std::array<double, 3> at{};
  for (std::size_t c = 0; c < dimension_; ++c) at[c] = in_cells(x_[slot * stride_ + static_cast<std::ptrdiff_t>(c)], c);
  return at;
}

std::array<double, 3> CellList::corner(Index cell) const {
  std::array<Index, 3> const at = indices_of(cell);
  std::array<double, 3> corner{};
  for (std::size_t c = 0; c < dimension_; ++c) corner[c] = span_[c].low + at[c] - 1;
  return corner;
}

std::size_t CellList::bytes() const {
  return sizeof(Index) * (slot_.size() + sorted_.size() + cell_.size() + begin_.size() + key_.size()) +
         sizeof(float) * 3 * place_[0].size();
}

}  // namespace piola
