// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/rigid_surface.hpp"
#include <array>
#include <cstdint>
#include <vector>

namespace piola::contact {

/// A shape thinner than this number of spacings of a body is thin: points of the body could pass its middle.
inline constexpr double thin_below = 4;

/// A point of the surface of a rigid shape, in the axes that the shape has at the start.
struct ShapePoint {
  std::int64_t key = 0;  ///< constant number on the shape
  Vec<3> arm, normal;    ///< from the centre [m]; outward unit normal
  double area = 0;       ///< contact area [m2]; in 2D a length [m]
};

/// A box in the axes of a shape, about its centre [m].
struct ShapeRange {
  Vec<3> low, high;
  bool holds(Vec<3> const& arm) const;
};

/// Surface points of a rigid shape where the points of a body are too coarse: within one spacing of the edges of a box
/// and the rims of a cylinder, and all over a thin sphere or cylinder. They are a third of a spacing apart (2D: a
/// quarter), including edges and corners. Points are generated on demand, because a large floor has many edges.
class ShapePoints {
 public:
  /// spacing: of the body [m].
  ShapePoints(RigidSurface const& shape, double spacing);
  /// Whether the shape has such points: not for planes and large spheres.
  bool any() const;
  /// Whether they cover a thin sphere or cylinder, so that points of the body need not be tested against it.
  bool cover() const { return thin_round_; }
  /// Points within a range, ordered by key.
  std::vector<ShapePoint> within(ShapeRange const& range) const;

 private:
  struct Ring {
    Vec<3> middle;              ///< [m]
    double radius, area;        ///< of the circle [m]; of its points together [m2]
    Vec<3> normal;              ///< of all points
    double outward;             ///< radial fraction of the normals: 1 on the side of a cylinder, else 0
    std::int64_t first, count;  ///< key of the first point, number of points
  };
  void face(int across, double side, std::int64_t first, ShapeRange const& range, std::vector<ShapePoint>& all) const;
  std::int64_t points_of_face(int across) const;
  /// Widening of a shape narrower than a spacing, which acts like one of that width, the resolution of the body.
  double widening(double width) const;
  std::vector<Ring> rings() const;
  void add_ring(Ring ring, std::vector<Ring>& all) const;
  void sphere(ShapeRange const& range, std::vector<ShapePoint>& all) const;

  RigidSurface shape_;
  double spacing_, step_;  ///< [m]
  bool thin_round_;
};

}  // namespace piola::contact
