// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/rigid_motion.hpp"
#include "piola/setup/contact_surface.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola::contact {
namespace {

using Kind = RigidShape::Kind;

/// A block of 5 x 3 (x 5) points and free shapes that lie on it, a little inside.
struct Lying {
  ParticleSet set;
  std::vector<Surface> surfaces;
  std::vector<RigidShape> shapes;
  int dimension;

  Lying(int D, Kind kind) : dimension(D) {
    ShapeSpec box;
    box.dimension = D;
    box.placement = ShapeSpec::Placement::cell_centred;
    for (std::size_t c = 0; c < static_cast<std::size_t>(D); ++c) {
      box.particles[c] = c == 1 ? 3 : 5;
      box.max[c] = box.particles[c];
    }
    fill(box, "block", set);
    surfaces.push_back(contact_surface(box, set, set.bodies.back()));
    surfaces.back().modulus = 2e6;
    RigidShape free;
    free.kind = kind;
    free.free = true;
    free.mass = 7;
    free.radius = 1.4;
    free.half_lengths = {1.4, 1, 1.3};
    free.centre = {2.3, kind == Kind::box ? 3.8 : 4.1, D == 3 ? 2.4 : 0};
    free.axis = {1, 0, 0};
    free.angular_velocity = {Expression(D == 3 ? "0.3" : "0"), Expression(D == 3 ? "0.1" : "0"), Expression("0.5")};
    shapes.push_back(free);
  }
  SurfaceContactSystem system(double friction, bool is_active = true) const {
    return {set, surfaces, {surface_of(shapes[0], dimension)}, touching(friction, is_active)};
  }
  static PairSettings touching(double friction, bool is_active = true) {
    return {{PairSetting{}, PairSetting{is_active, 0.5, {.kinetic = friction}}}};
  }
  std::vector<Vec<3>> places(SurfaceContactSystem const& system) const {
    std::vector<Vec<3>> x;
    for (auto const id : system.ids()) {
      auto const& X = set.X[static_cast<std::size_t>(id)];
      x.push_back({{X[0] + 0.02 * X[1], X[1] - 0.01 * X[0], X[2]}});
    }
    return x;
  }
};

struct Scene {
  int dimension;
  Kind kind;
};

class FreeShapes : public ::testing::TestWithParam<Scene> {};

TEST_P(FreeShapes, AreSeenByBodiesThatMeetThem) {
  Lying const lying(GetParam().dimension, GetParam().kind);
  SurfaceContactSystem system = lying.system(0);
  system.evaluate(lying.places(system), 1e-3);
  EXPECT_GT(system.totals().touched, 0);
  SurfaceContactSystem apart = lying.system(0, false);
  apart.evaluate(lying.places(apart), 1e-3);
  EXPECT_EQ(apart.totals().touched, 0);
}

TEST_P(FreeShapes, ForceAndMomentAreTheSlopesOfTheEnergy) {
  auto const [D, kind] = GetParam();
  Lying const lying(D, kind);
  SurfaceContactSystem system = lying.system(0);
  RigidMotion motion(lying.shapes, D, {1, 1, {}});
  motion.place(system.rigids());
  auto const x = lying.places(system);
  RigidSurface& s = system.rigid(0);
  Mat<3> const tilt = matrix_of(turn_by(D == 3 ? Vec<3>{{0.05, 0.02, 0.1}} : Vec<3>{{0, 0, 0.1}}));
  s.turn = tilt;
  s.axis = tilt * s.axis;
  RigidSurface const kept = s;
  system.evaluate(x, 1e-3);
  auto const load = system.resultant_on_rigid(0);
  double const size = std::sqrt(dot(load.force, load.force));
  ASSERT_GT(size, 0);
  auto const energy = [&] {
    system.evaluate(x, 1e-3);
    double const E = system.totals().energy;
    s = kept;
    return E;
  };
  for (int c = 0; c < D; ++c) {
    constexpr double h = 1e-6;
    double slopes[2];
    for (int turn = 0; turn < 2; ++turn) {
      double E[2];
      for (int side = 0; side < 2; ++side) {
        Vec<3> by;
        by[turn != 0 && D == 2 ? 2 : c] = side == 0 ? -h : h;
        if (turn == 0) {
          s.centre = s.centre + by;
        } else {
          s.turn = matrix_of(turn_by(by)) * s.turn;
          s.axis = matrix_of(turn_by(by)) * s.axis;
        }
        E[side] = energy();
      }
      slopes[turn] = (E[1] - E[0]) / (2 * h);
    }
    EXPECT_NEAR(load.force[c], -slopes[0], 2e-6 * size);
    EXPECT_NEAR(load.moment[D == 2 ? 2 : c], -slopes[1], 2e-6 * size);
  }
}

TEST_P(FreeShapes, MomentaOfBodyAndShapeAreKeptWithFriction) {
  auto const [D, kind] = GetParam();
  Lying const lying(D, kind);
  SurfaceContactSystem system = lying.system(0.4);
  RigidMotion motion(lying.shapes, D, {1, 1, {0.4}});
  motion.place(system.rigids());
  auto const x = lying.places(system);
  system.start(x);
  motion.start(system);
  motion.move(system.rigids(), 0, 0.05);
  system.evaluate(x, 1e-3);
  motion.evaluate(system, 0.05);
  ASSERT_GT(system.totals().spring_energy, 0) << "the shape has turned on the block";
  Vec<3> force, moment;
  double size = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    force = force + system.forces()[k];
    moment = moment + cross(x[k], system.forces()[k]);
    size += std::sqrt(dot(system.forces()[k], system.forces()[k]));
  }
  Vec<3> const P = motion.linear_momentum(), L = motion.angular_momentum();
  constexpr double h = 1e-3;
  motion.kick(system, 0, h);
  Vec<3> const pushed = (1 / h) * (motion.linear_momentum() - P), turned = (1 / h) * (motion.angular_momentum() - L);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(pushed[c], -force[c], 1e-12 * size);
    EXPECT_NEAR(turned[c], -moment[c], 1e-11 * size);
  }
  EXPECT_GT(motion.frequency2(), system.totals().frequency2) << "the shape gives way, too";
}

TEST_P(FreeShapes, FrictionIsBlindToCommonMotion) {
  auto const [D, kind] = GetParam();
  Lying const lying(D, kind);
  SurfaceContactSystem system = lying.system(0.4);
  auto x = lying.places(system);
  system.start(x);
  for (std::size_t k = 0; k < x.size(); ++k) x[k][0] += 0.01;
  system.evaluate(x, 1e-3);
  double const stored = system.totals().spring_energy;
  ASSERT_GT(stored, 0);
  Mat<3> const R = matrix_of(turn_by({{0, 0, 0.3}}));
  RigidSurface& s = system.rigid(0);
  for (int turns = 0; turns < 8; ++turns) {
    for (Vec<3>& y : x) y = R * y + Vec<3>{{0.1, -0.2, 0}};
    s.centre = R * s.centre + Vec<3>{{0.1, -0.2, 0}};
    s.turn = R * s.turn;
    s.axis = R * s.axis;
    system.evaluate(x, 1e-3);
    EXPECT_NEAR(system.totals().spring_energy / stored, 1, 1e-10);
    EXPECT_NEAR(system.totals().friction_work, 0, 1e-10 * stored);
  }
}

TEST_P(FreeShapes, ListsSeeTurns) {
  auto const [D, kind] = GetParam();
  if (kind == Kind::sphere) GTEST_SKIP() << "it looks the same";
  Lying lying(D, kind);
  lying.shapes[0].half_lengths = {0.9, 0.2, 3};
  lying.shapes[0].radius = 0.2;
  lying.shapes[0].centre = {2.55, 3.85, D == 3 ? 2.5 : 0};
  SurfaceContactSystem system = lying.system(0);
  auto const x = lying.places(system);
  system.start(x);
  EXPECT_EQ(system.totals().touched, 0);
  Mat<3> const R = matrix_of(turn_by({{0, 0, M_PI / 2}}));
  system.rigid(0).turn = R;
  system.rigid(0).axis = R * system.rigid(0).axis;
  system.evaluate(x, 1e-3);
  EXPECT_GT(system.totals().touched, 0) << "its end has come down";
}

INSTANTIATE_TEST_SUITE_P(Contact, FreeShapes,
                         ::testing::Values(Scene{2, Kind::sphere}, Scene{2, Kind::box}, Scene{3, Kind::sphere},
                                           Scene{3, Kind::cylinder}, Scene{3, Kind::box}));

TEST(RigidMotion, DrivenShapesTurnAsPrescribed) {
  RigidShape shape;
  shape.kind = Kind::plane;
  shape.axis = {1, 0, 0};
  shape.angular_velocity[2] = Expression("2*t");
  RigidMotion motion({shape}, 2, {1, 1, {}});
  EXPECT_TRUE(motion.any());
  std::vector<RigidSurface> surfaces{surface_of(shape, 2)};
  motion.place(surfaces);
  for (int k = 0; k < 10; ++k) motion.move(surfaces, 0.1 * k, 0.1);
  EXPECT_NEAR(surfaces[0].axis[0], std::cos(1.0), 1e-13);
  EXPECT_NEAR(surfaces[0].axis[1], std::sin(1.0), 1e-13);
  EXPECT_NEAR(surfaces[0].angular_velocity[2], 2, 1e-13);
  EXPECT_NEAR(motion.contact_time_step(surfaces), 0.1, 1e-12) << "a fifth of a radian";
  EXPECT_NEAR(motion.states(surfaces)[0].turn[2], 1, 1e-13);
}

TEST(RigidMotion, GravityAndWhatHoldsAShapeDoWork) {
  RigidShape shape;
  shape.kind = Kind::sphere;
  shape.radius = 1;
  shape.free = true;
  shape.mass = 2;
  shape.velocity = {Expression("3"), Expression("1"), Expression("0")};
  shape.gravity = {Expression("5"), Expression("-10"), Expression("0")};
  shape.held = {true, false, false};
  ParticleSet set;
  ShapeSpec box;
  box.max = {1, 1, 1};
  box.particles = {3, 3, 3};
  fill(box, "far", set);
  std::vector<Surface> surfaces{contact_surface(box, set, set.bodies[0])};
  shape.centre = {50, 0, 0};
  SurfaceContactSystem system(set, surfaces, {surface_of(shape, 3)}, Lying::touching(0));
  RigidMotion motion({shape}, 3, {1, 1, {}});
  motion.place(system.rigids());
  motion.start(system);
  double const before = motion.kinetic_energy();
  for (int k = 0; k < 10; ++k) {
    motion.kick(system, 0.1 * k, 0.05);
    motion.move(system.rigids(), 0.1 * k, 0.1);
    motion.kick(system, 0.1 * (k + 1), 0.05);
  }
  EXPECT_NEAR(system.rigid(0).centre[0], 53, 1e-12) << "held at its speed";
  EXPECT_NEAR(system.rigid(0).centre[1], 1 - 5, 1e-12);
  EXPECT_NEAR(motion.kinetic_energy() - before, motion.work(), 1e-12);
  motion.damp(system, 0);
  EXPECT_NEAR(motion.kinetic_energy(), 9, 1e-12);
}

}  // namespace
}  // namespace piola::contact
