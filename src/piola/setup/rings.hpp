// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/setup/shapes.hpp"

namespace piola {

/// Particles of a two-dimensional body on circles about its centre; see `fill` for where they are.
struct RingParticles {
  std::vector<std::array<double, 3>> X;           ///< [m]
  std::vector<std::array<int, 3>> lattice_index;  ///< disc: cell of a lattice; ring: number along the circle, circle
  std::vector<double> volume;                     ///< m^2
  std::array<double, 3> spacing{1, 1, 1};         ///< between circles [m]
  std::array<int, 3> lattice{1, 1, 1};            ///< range of the lattice indices
};

/// The particles of a shape whose arrangement is not a lattice.
RingParticles ring_particles(ShapeSpec const& shape);

/// How many they are, without making those of a large body: exact up to about 1e8, an estimate beyond.
double count_ring_particles(ShapeSpec const& shape);

}  // namespace piola
