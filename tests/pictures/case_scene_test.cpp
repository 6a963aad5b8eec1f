// SPDX-License-Identifier: Apache-2.0
#include "piola/pictures/case_scene.hpp"
#include "support/sample_case.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

constexpr char const* gravity = R"(
[[load]]
body = "column"
acceleration = [0, 0, "-9.81 m/s^2"]
)";

Up of(std::string const& more) { return upwards(read_case_text(test::sample_case() + more, "case.toml")); }

TEST(Upwards, IsYUnlessTheCaseSaysOtherwise) {
  EXPECT_EQ(of(""), Up::y);
  EXPECT_EQ(of("[output.pictures]\nevery = 1\nup = \"-x\"\n"), Up::minus_x);
}

TEST(Upwards, IsAgainstGravity) {
  EXPECT_EQ(of(gravity), Up::z);
  EXPECT_EQ(of("[[load]]\nbody = \"column\"\nacceleration = [\"3 m/s^2\", 0, 0]\n"), Up::minus_x);
  EXPECT_EQ(of(std::string(gravity) + "[output.pictures]\nevery = 1\nup = \"y\"\n"), Up::y);
}

TEST(Upwards, IgnoresLoadsThatAreNoGravity) {
  EXPECT_EQ(of("[[load]]\nbody = \"column\"\nacceleration = [0, 0, \"sin(t)\"]\n"), Up::y) << "changes in time";
  EXPECT_EQ(of("[[load]]\nbody = \"column\"\nacceleration = [1, 0, 1]\n"), Up::y) << "oblique";
  EXPECT_EQ(of("[[load]]\nbody = \"column\"\nacceleration = [0, 0, 0]\n"), Up::y) << "none";
  EXPECT_EQ(of("[[load]]\nbody = \"column\"\nbody_force = [0, 0, -1]\n"), Up::y) << "a force";
  EXPECT_EQ(of("[[load]]\nbody = \"column\"\nwhere = \"Y > 3\"\nacceleration = [0, 0, -1]\n"), Up::y) << "of a part";
}

CaseSpec with_plane(std::array<double, 3> const& normal, std::string const& velocity) {
  CaseSpec spec = read_case_text(test::sample_case(), "case.toml");
  RigidSpec plane;
  plane.axis = normal;
  plane.velocity = {Expression(velocity), Expression("0"), Expression("2*t")};
  spec.rigids.push_back(plane);
  return spec;
}

TEST(Upwards, IsTheNormalOfARestingPlane) {
  CaseSpec spec = with_plane({0, 0, 1}, "0");
  spec.rigids[0].velocity[2] = Expression("0");
  EXPECT_EQ(upwards(spec), Up::z);
  spec.rigids[0].velocity[0] = Expression("1");
  EXPECT_EQ(upwards(spec), Up::y) << "it moves";
  spec.rigids[0].velocity[0] = Expression("0");
  spec.rigids[0].axis = {0.6, 0, 0.8};
  EXPECT_EQ(upwards(spec), Up::y) << "it is oblique";
  spec.rigids[0].axis = {0, 0, 1};
  spec.rigids[0].kind = RigidShape::Kind::box;
  EXPECT_EQ(upwards(spec), Up::y) << "it is no plane";
}

TEST(Ground, LiesAcrossTheUpwardAxisIfAskedFor) {
  CaseSpec spec = with_plane({0, 0, 1}, "0");
  spec.rigids[0].velocity[2] = Expression("0");
  EXPECT_FALSE(ground_of(spec, spec.output.pictures));
  spec.output.pictures.ground = true;
  ASSERT_TRUE(ground_of(spec, spec.output.pictures));
  EXPECT_NEAR((*ground_of(spec, spec.output.pictures))[2], 1, 1e-12);
}

TEST(LooseParticles, AreDamagedThroughOrEulerian) {
  std::vector<double> const damage{0, 0.99, 1, 0}, kernel_type{0, 0, 0, 1};
  EXPECT_EQ(loose_particles(damage, kernel_type, 4), (std::vector<std::uint8_t>{0, 0, 1, 1}));
  EXPECT_EQ(loose_particles({}, kernel_type, 4), (std::vector<std::uint8_t>{0, 0, 0, 1}));
  EXPECT_EQ(loose_particles({}, {}, 2), (std::vector<std::uint8_t>{0, 0}));
}

TEST(Shapes, StandWhereTheirVelocityHasTakenThem) {
  CaseSpec spec = with_plane({0, 1, 0}, "3");
  spec.rigids[0].centre = {1, 2, 3};
  auto const shapes = shapes_at(spec.rigids, 0.5);
  ASSERT_EQ(shapes.size(), 1u);
  EXPECT_DOUBLE_EQ(shapes[0].centre[0], 2.5);
  EXPECT_DOUBLE_EQ(shapes[0].centre[1], 2);
  EXPECT_NEAR(shapes[0].centre[2], 3.25, 1e-12);  // the integral of 2 t
}

TEST(Shapes, ThatTurnStandAsTheirPosesSay) {
  RigidSpec stone;
  stone.kind = RigidShape::Kind::box;
  stone.free = true;
  stone.centre = {7, 8, 9};
  std::array const pose{3.0, 2.0, 3.0, 0.0, 0.0, 0.4};
  auto const shapes = shapes_at({stone}, 2, pose);
  ASSERT_EQ(shapes.size(), 1U);
  EXPECT_EQ(shapes[0].centre, (std::array{3.0, 2.0, 3.0}));
  EXPECT_NEAR(shapes[0].edges[0][1], std::sin(0.4), 1e-12);
  EXPECT_EQ(shapes_at({stone}, 2)[0].centre[0], 7) << "where it started, for want of a pose";
}

TEST(Warp, EnlargesDisplacementsAndSaysSo) {
  std::vector<std::array<double, 3>> const X{{1, 2, 3}}, x{{1.5, 2, 2}};
  EXPECT_EQ(warped(x, X, 1), x);
  EXPECT_EQ(warped(x, X, 10)[0], (std::array{6.0, 2.0, -7.0}));
  EXPECT_EQ(warped(x, X, 0), X);
  PictureSpec picture;
  EXPECT_EQ(title_of("A", picture), "A");
  picture.warp = 10;
  EXPECT_EQ(title_of("A", picture), "A, displacements \u00d7 10");
}

TEST(HeldParticles, AreThoseOfTheSupports) {
  ParticleSet particles;
  CaseSpec const spec = read_case_text(test::sample_case(), "case.toml", {}, {}, &particles);
  auto const held = held_particles(spec, particles);
  ASSERT_EQ(held.size(), particles.X.size());
  for (std::size_t i = 0; i < held.size(); ++i) EXPECT_EQ(held[i] != 0, particles.X[i][1] <= 0) << i;
}

}  // namespace
}  // namespace piola
