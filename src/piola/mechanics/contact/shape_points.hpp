// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/rigid.hpp"
#include <array>
#include <cstdint>
#include <vector>

namespace piola::contact {

/// A shape thinner than this many spacings of a body is thin: points of the body could get past its middle.
inline constexpr double thin_below = 4;

/// A point of the surface of a rigid shape, in the axes that the shape has at the start.
struct ShapePoint {
  std::int64_t key = 0;  ///< its number on the shape, which never changes
  Vec<3> arm, normal;    ///< from the centre [m]; outward unit normal
  double area = 0;       ///< that it pushes with [m2]; in 2D a length [m]
};

/// A box in the axes of a shape, about its centre [m].
struct ShapeRange {
  Vec<3> low, high;
  bool holds(Vec<3> const& arm) const;
};

/// Points of the surface of a rigid shape where the points of a body are too far apart to feel it: within one spacing
/// of the edges of a box and the rims of a cylinder, and all over a sphere or a cylinder that is thin. They are a third
/// of a spacing apart (2D: a quarter), edges and corners among them. No list is kept: a large floor has many edges.
class ShapePoints {
 public:
  /// spacing: of the body [m].
  ShapePoints(RigidSurface const& shape, double spacing);
  /// Whether the shape has such points: planes and large spheres have none.
  bool any() const;
  /// Whether they cover a sphere or a cylinder that is thin: the body need not test its own points against the shape.
  bool cover() const { return thin_round_; }
  /// Points within a range, ordered by key.
  std::vector<ShapePoint> within(ShapeRange const& range) const;

 private:
  struct Ring {
    Vec<3> middle;              ///< [m]
    double radius, area;        ///< of the circle [m]; of its points together [m2]
    Vec<3> normal;              ///< of all points
    double outward;             ///< share of the radial direction in normals: 1 on the side of a cylinder, else 0
    std::int64_t first, count;  ///< key of the first point, number of points
  };
  void face(int across, double side, std::int64_t first, ShapeRange const& range, std::vector<ShapePoint>& all) const;
  std::int64_t points_of_face(int across) const;
  /// A shape narrower than a spacing pushes as if it were that wide, since no body feels less.
  double widening(double width) const;
  std::vector<Ring> rings() const;
  void add_ring(Ring ring, std::vector<Ring>& all) const;
  void sphere(ShapeRange const& range, std::vector<ShapePoint>& all) const;

  RigidSurface shape_;
  double spacing_, step_;  ///< [m]
  bool thin_round_;
};

}  // namespace piola::contact
