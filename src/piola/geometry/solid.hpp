// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Common interface of shapes: signed distance of a place, and a surface that consists of patches. Used by particles,
/// supports, loads and contact.
namespace piola::geometry {

/// Signed distance and normal of a solid at a place.
struct Foot {
  double distance = 0;  ///< to the surface, negative inside [m]
  Vec<3> normal{};      ///< unit vector straight away from the solid, also inside it
};

/// A box with edges along the axes [m]. In 2D z is 0.
struct Bounds {
  Vec<3> min{}, max{};
};

/// A small part of a surface.
struct SurfacePiece {
  Vec<3> X{};     ///< its middle [m]
  Vec<3> area{};  ///< outward vector area [m2]; in 2D length times normal [m]
  int patch = 0;  ///< counted as in Solid::patches
};

/// A part of the surface that users can name: the side of a cylinder, the face of a box, a group of triangles.
struct Patch {
  std::string name;  ///< "+x", "side", "3", "bore"
};

/// A region with a surface, in the reference configuration. Immutable, hence thread-safe.
class Solid {
 public:
  Solid() = default;
  Solid(Solid const&) = delete;
  Solid& operator=(Solid const&) = delete;
  virtual ~Solid() = default;

  virtual int dimension() const { return 3; }  ///< 2: independent of z, and surfaces are curves

  /// Signed distance of X to the surface and unit normal away from the solid. Exact close to the surface except at
  /// seams of combined solids; |distance| is never above the true one if distance_is_bound(). Where several places are
  /// nearest, as on the axis of a cylinder, the normal belongs to any of them.
  virtual Foot at(Vec<3> const& X) const = 0;

  /// Whether |distance| is never above the true one, so that the ball of this radius about X does not cross the
  /// surface.
  virtual bool distance_is_bound() const { return true; }

  /// Bounding box, tight where that is cheap; infinite for half-spaces.
  virtual Bounds bounds() const = 0;

  /// The volume [m3; 2D m2] where a formula or a sum over the surface gives it: to round-off but for level sets.
  virtual std::optional<double> exact_volume() const { return {}; }

  /// The patches of the surface, in the order of SurfacePiece::patch.
  virtual std::vector<Patch> patches() const = 0;

  /// Appends the surface, cut into pieces no longer than `edge` [m] in any direction. The sum of |area| over a patch is
  /// its area where the surface is flat or its curvature is known; over a closed surface the vector areas sum to zero
  /// to round-off.
  virtual void cut_surface(double edge, std::vector<SurfacePiece>& pieces) const = 0;
};

using SolidPtr = std::shared_ptr<Solid const>;

}  // namespace piola::geometry
