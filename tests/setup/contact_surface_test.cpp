// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/contact_surface.hpp"
#include "piola/math/array_conversion.hpp"
#include "piola/model/read_case.hpp"
#include "piola/setup/packed_bodies.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

struct Points {
  double farthest = 0;  ///< of a point from the surface, in spacings
  double area = 0;
};

/// The surface points of a packed shape with a spacing of 0.2.
Points points_of(std::string const& shape) {
  CaseSpec const spec = read_case_text(
      "title = \"Surface\"\n[run]\nend = 1\n[[body]]\nname = \"body\"\nshape = { spacing = 0.2, arrangement = "
      "\"packed\", " +
          shape +
          " }\nmaterial = { law = \"neo_hookean\", density = 1, youngs_modulus = 1, poissons_ratio = 0.3 }\n"
          "formulation = { name = \"nodal\" }\n",
      "surface.toml");
  ShapeSpec const& packed = spec.bodies[0].shape;
  ParticleSet particles;
  fill(packed, "body", particles);
  Points found;
  for (auto const& point : contact_surface(packed, particles, particles.bodies[0]).points) {
    Vec<3> const y = vector_of(particles.X[static_cast<std::size_t>(point.particle)]) + point.offset;
    found.farthest = std::max(found.farthest, std::fabs(packed.solid->at(y).distance) / 0.2);
    found.area += point.area;
  }
  return found;
}

// The mean of an arc of the length s lies s^2/(24 R) inside the circle: 0.008 spacings here, and more of larger shares.
TEST(ContactSurface, PointsOfPackedShapesLieOnCurvedFaces) {
  Points const ball = points_of("sphere = { centre = [0.3, 0, 0], radius = 1 }");
  EXPECT_LT(ball.farthest, 1e-4);
  EXPECT_NEAR(ball.area, 4 * M_PI, 0.01);
  Points const ring = points_of("sphere = { centre = [0, 0], radius = 1, inner_radius = 0.4 }");
  EXPECT_LT(ring.farthest, 1e-4);
  EXPECT_NEAR(ring.area, 2 * M_PI * 1.4, 0.01);
  Points const tube = points_of("cylinder = { centre = [0, 0, 0], radius = 1, inner_radius = 0.4, length = 1 }");
  EXPECT_LT(tube.farthest, 1e-4);
  EXPECT_NEAR(tube.area, 2 * M_PI * (1.4 + 0.84), 0.02);
}

}  // namespace
}  // namespace piola
