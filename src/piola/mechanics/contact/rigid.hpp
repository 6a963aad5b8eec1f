// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include "piola/mechanics/rigid_shape.hpp"
#include <array>
#include <optional>

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

  Mat<3> turn = identity<3>();   ///< since the start, when the edges of a box lie along the axes
  Vec<3> angular_velocity = {};  ///< about the centre [rad/s]
  double inverse_mass = 0;       ///< of a free body [1/kg]
  Mat<3> inverse_inertia = {};   ///< of a free body, about its centre [1/(kg m2)]

  Vec<3> velocity_at(Vec<3> const& y) const { return velocity + cross(angular_velocity, y - centre); }
  /// How fast unit impulses at y make it there, at most: along n, or in any directions at once [1/kg].
  double mobility(Vec<3> const& y, Vec<3> const& n) const;
  double mobility(Vec<3> const& y) const;
};

/// Where a rigid shape stands.
struct RigidPose {
  Vec<3> centre;
  Mat<3> turn = identity<3>();
};
inline RigidPose pose_of(RigidSurface const& shape) { return {shape.centre, shape.turn}; }

/// How far the point of a shape that is now at y has come since it stood in another pose [m].
inline Vec<3> moved_from(RigidPose const& last, RigidSurface const& now, Vec<3> const& y) {
  return now.centre - last.centre + (now.turn - last.turn) * (transpose(now.turn) * (y - now.centre));
}

/// No point of its surface is farther from the centre [m]; infinite of a plane.
double reach_of(RigidSurface const& shape);

/// Bounds how far points of its surface have come since it stood in another pose [m].
double travel_from(RigidPose const& last, RigidSurface const& now);

/// The surface of a shape at the start, in a space of so many dimensions.
RigidSurface surface_of(RigidShape const& shape, int dimension);

/// Signed distance of a point from it, negative inside [m], and its gradient, the outward normal.
struct Distance {
  double value = 0;
  Vec<3> normal;
};
Distance distance_from(RigidSurface const& shape, Vec<3> const& x);

/// The face of a thin shape by which a point came in, as a sign along one of its axes: the edges of a box, first the
/// axis of a cylinder. 0: the nearer face counts.
using Sides = std::array<int, 3>;
/// Signed distance of a point that is kept on its side: it is inside behind the face by which it came in, however deep.
Distance distance_from(RigidSurface const& shape, Vec<3> const& x, Sides const& sides);

/// Whether a shape is thinner than a length [m], along each of these axes. Spheres are not, and neither are cylinders
/// whose diameter is less.
std::array<bool, 3> thin_along(RigidSurface const& shape, double length);
/// How far behind the far face of a thin shape a point is that is kept on its side [m]; negative before it.
double beyond(RigidSurface const& shape, Vec<3> const& x, Sides const& sides);
/// The side on which a point has gone into a thin shape, or through it, by one of its wide faces since the shape was
/// `last` and the point at `before`; nothing: it has not.
std::optional<Sides> entered(RigidSurface const& shape, Vec<3> const& x, RigidPose const& last, Vec<3> const& before,
                             std::array<bool, 3> const& thin);

}  // namespace piola::contact
