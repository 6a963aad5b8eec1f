// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/lattice_layout.hpp"
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

}  // namespace piola::nodal
