// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/lattice_layout.hpp"
#include "piola/base/contracts.hpp"
#include "piola/formulations/nodal/quadratic.hpp"
#include <algorithm>
#include <numeric>

namespace piola::nodal {
namespace {

/// The candidate lattice of a body.
LatticeShape shape_of(ParticleSet const& set, Body const& body) {
  LatticeShape shape;
  shape.dimension = set.dimension;
  auto const D = static_cast<std::ptrdiff_t>(set.dimension);
  std::stable_sort(shape.axis.begin(), shape.axis.begin() + D,
                   [&](std::size_t a, std::size_t b) { return body.lattice[a] > body.lattice[b]; });
  // The longest direction last: partitions, which are runs of slots, are slabs across it.
  std::rotate(shape.axis.begin(), shape.axis.begin() + 1, shape.axis.begin() + D);
  for (std::size_t c = 0; c < static_cast<std::size_t>(D); ++c) shape.count[c] = body.lattice[shape.axis[c]];
  return shape;
}

/// Loops of a lattice go by blocks over all of it, and a law belongs to whole ranges of slots.
bool has_parts(ParticleSet const& set, Body const& body) {
  for (auto id = body.first; id < body.last; ++id)
    if (part_of(set, static_cast<std::size_t>(id)) != 0) return true;
  return false;
}

/// Particles of one part stand together, in the order that they had.
SlotOrder part_by_part(ParticleSet const& set, SlotOrder order) {
  std::stable_sort(order.id.begin(), order.id.begin() + order.particles, [&](std::int64_t a, std::int64_t b) {
    return part_of(set, static_cast<std::size_t>(a)) < part_of(set, static_cast<std::size_t>(b));
  });
  return order;
}

bool may_fill(ParticleSet const& set, Body const& body, LatticeShape const& shape) {
  auto const points = static_cast<std::int64_t>(shape.count[0]) * shape.count[1] * shape.count[2];
  return body.regular && !body.off_lattice && !has_parts(set, body) && body.last - body.first == points;
}

}  // namespace

SlotOrder slot_order(ParticleSet const& set, Body const& body) {
  LatticeShape const shape = shape_of(set, body);
  if (has_parts(set, body)) return part_by_part(set, pencil_order(set, body));
  if (!may_fill(set, body, shape)) return pencil_order(set, body);
  std::vector<std::size_t> row_order(static_cast<std::size_t>(shape.count[1]) *
                                     static_cast<std::size_t>(shape.count[2]));
  std::iota(row_order.begin(), row_order.end(), std::size_t{0});
  return order_by_rows(set, body, shape.axis, row_order);
}

std::optional<LatticeShape> lattice_shape(ParticleSet const& set, Body const& body, SlotOrder const& order) {
  LatticeShape const shape = shape_of(set, body);
  if (!may_fill(set, body, shape)) return std::nullopt;
  for (Index i = 0; i < order.particles; ++i) {
    auto const& at = set.lattice_index[static_cast<std::size_t>(order.id[static_cast<std::size_t>(i)])];
    if (shape.place(i) != std::array{at[shape.axis[0]], at[shape.axis[1]], at[shape.axis[2]]}) return std::nullopt;
  }
  return shape;
}

LatticeLayout::LatticeLayout(LatticeShape const& shape, Index slots, int lanes) {
  PIOLA_EXPECTS(slots >= 0 && lanes >= 1);
  table_.row = shape.count[0];
  table_.plane = static_cast<std::ptrdiff_t>(shape.count[0]) * shape.count[1];
  constexpr std::ptrdiff_t reach = 2, widest_lanes = 8;
  guard_ = static_cast<Index>(
      reach * ((shape.dimension > 1 ? table_.row : 0) + (shape.dimension > 2 ? table_.plane : 0)) + widest_lanes);
  if (shape.dimension == 1) mark<1>(shape, slots, lanes);
  if (shape.dimension == 2) mark<2>(shape, slots, lanes);
  if (shape.dimension == 3) mark<3>(shape, slots, lanes);
}

template <int D>
void LatticeLayout::mark(LatticeShape const& shape, Index slots, int lanes) {
  using Rows = LatticeRows<D>;
  std::array<int, 3> axis{};
  for (std::size_t c = 0; c < 3; ++c) axis[c] = static_cast<int>(shape.axis[c]);
  auto const second = [&](int m, int n) {
    return 1 + D + Quadratic<D>::at(axis[static_cast<std::size_t>(m)], axis[static_cast<std::size_t>(n)]);
  };
  table_.place[1][0] = 1 + axis[0];
  table_.place[2][0] = second(0, 0);
  for (int t = 1; t < D; ++t) {
    table_.place[0][t] = 1 + axis[static_cast<std::size_t>(t)];
    table_.place[1][t] = second(0, t);
    table_.place[0][D - 1 + t] = second(t, t);
  }
  if (D == 3) table_.place[0][5] = second(1, 2);
  present_.assign(static_cast<std::size_t>(slots / lanes) * Rows::bits, 0);
  Index const particles = shape.count[0] * shape.count[1] * shape.count[2];
  for (Index i = 0; i < particles; ++i) {
    auto const at = shape.place(i);
    auto* const bits = &present_[static_cast<std::size_t>(i / lanes) * Rows::bits];
    auto const set = [&](int bit, std::array<int, 3> const& to) {
      if (shape.has(to)) bits[bit] = static_cast<std::uint8_t>(bits[bit] | 1U << (i % lanes));
    };
    for (int h = 0; h < Rows::pairs; ++h) {
      LatticeRow const r = Rows::pair[h];
      set(2 * h, {at[0], at[1] + r.j, at[2] + r.k});
      set(2 * h + 1, {at[0], at[1] - r.j, at[2] - r.k});
    }
    for (int k = 0; k < 4; ++k) set(2 * Rows::pairs + k, {at[0] + (k % 2 == 0 ? 1 : -1) * (k / 2 + 1), at[1], at[2]});
  }
}

}  // namespace piola::nodal
