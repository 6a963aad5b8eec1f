// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/solid.hpp"

namespace piola::geometry {

/// X -> scale * R * X + move.
struct RigidTransform {
  double scale = 1;
  Mat<3> rotation = identity<3>();  ///< proper
  Vec<3> move{};                    ///< [m]
};

/// The rotation about a unit vector by an angle [rad] (Rodrigues).
Mat<3> rotation_about(Vec<3> const& axis, double angle);
/// A rotation that takes the z axis to a unit vector; the identity for the z axis itself.
Mat<3> rotation_from_z(Vec<3> const& axis);

/// A solid in another place. Half-spaces stay half-spaces.
SolidPtr placed(SolidPtr solid, RigidTransform const& placing);

/// A half-space has a finite surface only where other solids bound it.
class HalfSpace final : public Solid {
 public:
  HalfSpace(Vec<3> const& point, Vec<3> const& normal, int dimension)
      : point_(point), normal_(normal), dimension_(dimension) {}
  int dimension() const override { return dimension_; }
  Foot at(Vec<3> const& X) const override { return {dot(X - point_, normal_), normal_}; }
  Bounds bounds() const override;
  std::vector<Patch> patches() const override { return {{"plane"}}; }
  /// Nothing: it has no end.
  void cut_surface(double /*edge*/, std::vector<SurfacePiece>& /*pieces*/) const override {}
  /// The part of its surface around a box.
  void cut_surface_around(Bounds const& box, double edge, std::vector<SurfacePiece>& pieces) const;
  Vec<3> const& point() const { return point_; }
  Vec<3> const& normal() const { return normal_; }

 private:
  Vec<3> point_, normal_;
  int dimension_;
};

}  // namespace piola::geometry
