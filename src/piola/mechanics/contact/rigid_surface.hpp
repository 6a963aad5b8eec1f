// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include "piola/mechanics/rigid_shape.hpp"
#include <array>
#include <optional>

namespace piola::contact {

/// The surface of a rigid shape in its current pose.
struct RigidSurface {
  using Kind = RigidShape::Kind;
  Kind kind = Kind::plane;
  int dimension = 3;
  Vec<3> centre;           ///< of sphere, cylinder and box; for a plane: a point on it [m]
  Vec<3> axis{{0, 0, 1}};  ///< unit vector: plane: outward normal; cylinder: its axis
  Vec<3> half_lengths;     ///< box: half its edges; cylinder: half its length in the first [m]
  double radius = 0;       ///< sphere, cylinder [m]
  Vec<3> velocity;         ///< [m/s]

  Mat<3> turn = identity<3>();   ///< rotation since the start, when the edges of a box lie along the axes
  Vec<3> angular_velocity = {};  ///< about the centre [rad/s]
  double inverse_mass = 0;       ///< of a free body [1/kg]
  Mat<3> inverse_inertia = {};   ///< of a free body, about its centre [1/(kg m2)]

  Vec<3> velocity_at(Vec<3> const& y) const { return velocity + cross(angular_velocity, y - centre); }
  /// Upper bound of the velocity at y per unit impulse at y: along n, or in all directions [1/kg].
  double mobility(Vec<3> const& y, Vec<3> const& n) const;
  double mobility(Vec<3> const& y) const;
};

/// Pose of a rigid shape.
struct RigidPose {
  Vec<3> centre;
  Mat<3> turn = identity<3>();
};
inline RigidPose pose_of(RigidSurface const& shape) { return {shape.centre, shape.turn}; }

/// Displacement since pose `last` of the material point that is now at y [m].
inline Vec<3> moved_from(RigidPose const& last, RigidSurface const& now, Vec<3> const& y) {
  return now.centre - last.centre + (now.turn - last.turn) * (transpose(now.turn) * (y - now.centre));
}

/// Largest distance of its surface points from the centre [m]; infinite for a plane.
double reach_of(RigidSurface const& shape);

/// Bound of the displacement of its surface points since pose `last` [m].
double travel_from(RigidPose const& last, RigidSurface const& now);

/// The surface of a shape at the start, in a space of `dimension` dimensions.
RigidSurface surface_of(RigidShape const& shape, int dimension);

/// Signed distance of a point from it, negative inside [m], and its gradient, the outward normal.
struct Distance {
  double value = 0;
  Vec<3> normal;
};
Distance distance_from(RigidSurface const& shape, Vec<3> const& x);

/// Change of the outward normal of a distance per displacement of the point inside, applied to a vector: d(normal)/dx
/// times `along` [1/m times its unit]. Zero on flat faces.
Vec<3> normal_change(RigidSurface const& shape, Vec<3> const& x, Vec<3> const& normal, Vec<3> const& along);

/// The face by which a point entered a thin shape, as a sign along one of its axes: the edges of a box; for a cylinder
/// first its axis. 0: the nearer face counts.
using Sides = std::array<int, 3>;
/// Signed distance of a point with a recorded entry face: it stays inside behind that face at any depth.
Distance distance_from(RigidSurface const& shape, Vec<3> const& x, Sides const& sides);

/// Whether a shape is thinner than a length [m], along each of these axes. False for spheres, and for cylinders whose
/// diameter is less.
std::array<bool, 3> thin_along(RigidSurface const& shape, double length);
/// Depth behind the far face of a thin shape of a point with a recorded entry face [m]; negative in front of it.
double beyond(RigidSurface const& shape, Vec<3> const& x, Sides const& sides);
/// The entry face if a point has entered or crossed a thin shape by one of its wide faces since the shape was at `last`
/// and the point at `before`; else empty.
std::optional<Sides> entered(RigidSurface const& shape, Vec<3> const& x, RigidPose const& last, Vec<3> const& before,
                             std::array<bool, 3> const& thin);

}  // namespace piola::contact
