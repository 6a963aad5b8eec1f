// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include "piola/mechanics/rigid_shape.hpp"

namespace piola::contact {

/// The surface of a rigid shape where it is now.
struct RigidSurface {
  using Kind = RigidShape::Kind;
  Kind kind = Kind::plane;
  int dimension = 3;
  Vec<3> centre;           ///< of sphere, cylinder and box; a point of the plane [m]
  Vec<3> axis{{0, 0, 1}};  ///< unit vector: plane: outward normal; cylinder: its axis
  Vec<3> half_lengths;     ///< box: half its edges; cylinder: half its length in the first [m]
  double radius = 0;       ///< sphere, cylinder [m]
  Vec<3> velocity;         ///< [m/s]
};

/// The surface of a shape at the start, in a space of so many dimensions.
RigidSurface surface_of(RigidShape const& shape, int dimension);

/// Signed distance of a point from it, negative inside [m], and its gradient, the outward normal.
struct Distance {
  double value = 0;
  Vec<3> normal;
};
Distance distance_from(RigidSurface const& shape, Vec<3> const& x);

}  // namespace piola::contact
