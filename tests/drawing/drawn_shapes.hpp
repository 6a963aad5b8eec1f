// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/setup/shapes.hpp"

/// Shapes for tests of pictures.
namespace piola::testing {

/// A box of 2 x 1 x 0.5 m with 4n x 2n x n particles; in 2D 2 x 1 m with 4n x 2n.
inline ShapeSpec drawn_box(int n, ShapeSpec::Placement placement, int dimension = 3) {
  ShapeSpec shape;
  shape.dimension = dimension;
  shape.max = {2, 1, dimension == 3 ? 0.5 : 0};
  shape.particles = {4 * n, 2 * n, dimension == 3 ? n : 1};
  shape.placement = placement;
  return shape;
}

/// A solid cylinder along z on a cell-centred lattice.
inline ShapeSpec drawn_cylinder(double radius, double length, double spacing) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::cylinder;
  shape.radius = radius;
  shape.length = length;
  shape.spacing = spacing;
  shape.placement = ShapeSpec::Placement::cell_centred;
  return shape;
}

/// A 2D disc or annulus whose particles lie on concentric rings.
inline ShapeSpec drawn_rings(double radius, double spacing, double inner_radius = 0) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::sphere;
  shape.dimension = 2;
  shape.radius = radius;
  shape.inner_radius = inner_radius;
  shape.spacing = spacing;
  shape.arrangement = ShapeSpec::Arrangement::rings;
  return shape;
}

}  // namespace piola::testing
