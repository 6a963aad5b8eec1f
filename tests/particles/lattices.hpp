// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/setup/shapes.hpp"

namespace piola::testing {

/// The box [0, 1]^dimension with n particles per direction; the outer ones lie on the faces. Jitter moves inner
/// particles.
inline ParticleSet unit_box(int dimension, int n, double jitter = 0, std::uint32_t seed = 1) {
  ShapeSpec shape;
  shape.dimension = dimension;
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) {
    shape.max[c] = 1;
    shape.particles[c] = n;
  }
  shape.jitter = jitter;
  shape.seed = seed;
  ParticleSet set;
  fill(shape, "box", set);
  return set;
}

/// A box from the origin to `size` [m]; the outer particles lie on its faces.
inline ParticleSet box(std::array<double, 3> size, std::array<int, 3> particles, int dimension = 3) {
  ShapeSpec shape;
  shape.dimension = dimension;
  shape.max = size;
  shape.particles = particles;
  ParticleSet set;
  fill(shape, "box", set);
  return set;
}

}  // namespace piola::testing
