// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <vector>

namespace piola {

/// Order of a body's particles in memory: pencils of 8 x 8 lattice rows along the longest direction, rows in full. Then
/// neighbours lie at few distinct distances in memory (unit-stride loads), and the rows around a pencil stay in the
/// second-level cache. Empty slots at the end fill the last group of lanes.
struct SlotOrder {
  static constexpr Index no_particle = -1;
  static constexpr Index alignment = 16;  ///< slots are a multiple of it, hence of every lane count
  std::vector<std::int64_t> id;           ///< per slot: particle id, or no_particle
  Index particles = 0;
  Index slots() const { return static_cast<Index>(id.size()); }
};

/// Particles by rows of the lattice, in each along `axis[0]`, then by id. row_order[z * lattice[axis[1]] + y]: the
/// place of the row at y along axis[1] and z along axis[2] among all rows.
SlotOrder order_by_rows(ParticleSet const& set, Body const& body, std::array<std::size_t, 3> const& axis,
                        std::vector<std::size_t> const& row_order);

/// The axes of a body's lattice: the longest one first, along which its rows lie, then the remaining ones in order.
std::array<std::size_t, 3> row_axes(Body const& body);

SlotOrder pencil_order(ParticleSet const& set, Body const& body);

}  // namespace piola
