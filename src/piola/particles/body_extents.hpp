// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/particles/particle_set.hpp"
#include <array>

namespace piola {

/// Ends of a body along the axes, for mirror planes.
struct BodyExtents {
  std::array<double, 3> low, high;          ///< of its particles [m]
  std::array<std::array<double, 2>, 3> at;  ///< where the lower and the upper plane across an axis are, if any [m]
  double tolerance;                         ///< two places are the same [m]
};

/// A plane goes through the outermost particles, or half a spacing outside of them where the body does on both sides;
/// the axis of axisymmetric bodies through the origin.
BodyExtents extents_of(ParticleSet const& set, Body const& body);

/// Whether an axisymmetric body reaches the axis, which is then a mirror plane of its section.
bool touches_axis(ParticleSet const& set, Body const& body);

}  // namespace piola
