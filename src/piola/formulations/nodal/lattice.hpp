// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <cstdint>

/// Lattice data for loops: plain data, independent of the instruction set.
namespace piola::nodal {

/// Neighbours of particles that fill a lattice: the same offsets for all. Gradients differ near the surface of the
/// body; groups of lanes with the same ones share them. A gradient has D first and then the second derivatives; all
/// lanes of one number are contiguous.
struct LatticeTable {
  int offsets = 0;
  std::ptrdiff_t const* offset = nullptr;  ///< [offsets]: slots to the neighbour
  std::int32_t const* group = nullptr;     ///< per group of lanes: its gradients; nullptr: no lattice
  double const* motion =
      nullptr;  ///< [group][offsets][D + second][lanes]: (G_ab, K_ab); zero where there is no neighbour
  double const* force = nullptr;  ///< the same: V_b (G_ba, K_ba)
};

}  // namespace piola::nodal
