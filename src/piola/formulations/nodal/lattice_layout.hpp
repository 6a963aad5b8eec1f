// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/particles/ordering.hpp"
#include <array>
#include <optional>
#include <vector>

/// Memory order and neighbours of bodies that fill a lattice.
namespace piola::nodal {

/// A lattice that a body fills without gaps, in slot order: rows along the first direction, consecutive along the
/// second, planes along the third.
struct LatticeShape {
  int dimension = 3;
  std::array<std::size_t, 3> axis{0, 1, 2};  ///< of X, Y, Z, for the first, second, third direction
  std::array<int, 3> count{1, 1, 1};         ///< particles along these directions

  std::array<int, 3> place(Index slot) const {
    return {slot % count[0], slot / count[0] % count[1], slot / (count[0] * count[1])};
  }
  bool has(std::array<int, 3> const& at) const {
    for (std::size_t c = 0; c < 3; ++c)
      if (at[c] < 0 || at[c] >= count[c]) return false;
    return true;
  }
  Index slot(std::array<int, 3> const& at) const { return (at[2] * count[1] + at[1]) * count[0] + at[0]; }
};

/// Order of slots: row by row and plane by plane along the longest side on a lattice; else pencils.
SlotOrder slot_order(ParticleSet const& set, Body const& body);

/// The lattice that a body fills in this order; empty if none.
std::optional<LatticeShape> lattice_shape(ParticleSet const& set, Body const& body, SlotOrder const& order);

}  // namespace piola::nodal
