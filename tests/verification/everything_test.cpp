// SPDX-License-Identifier: Apache-2.0
#include "verification/surface_bodies.hpp"

/// All interactions between bodies in one run, in 3D with two formulations and unequal spacings: friction,
/// self-contact, contact of free rigid shapes, ties of bodies and of a rigid shape that hold or fail.
namespace piola {
namespace {

using namespace testing;
using Kind = RigidShape::Kind;

RigidShape stone(std::string const& name, Kind kind, Point const& centre, std::array<std::string, 3> const& velocity) {
  RigidShape s;
  s.name = name;
  s.kind = kind;
  s.centre = centre;
  s.radius = 0.25;
  s.half_lengths = {0.3, 0.1, 0.3};
  s.free = true;
  s.mass = 300;
  s.velocity = formulas(velocity);
  s.angular_velocity = formulas({"2", "-3", "4"});
  return s;
}

/// Three blocks in a row: the first two are tied and run into the third. A plate is tied under the first block, a ball
/// falls on the second one, and another ball hits that ball.
Assembly everything() {
  Assembly a;
  add_block(a, 3, "nodal", {-1, 0, 0}, 5, 0.2);
  add_block(a, 3, "jst_sph", {0, 0.1, 0.05}, 6, 0.15);
  add_block(a, 3, "nodal", {0.95, 0.3, -0.1}, 4, 0.23);
  give_velocity(a, [](Point const& X) {
    if (X[0] < 0) return Point{3 + X[1], 1 - X[0], 2 * X[1]};
    return X[0] < 0.9 ? Point{5, 0.5 * X[2], 0.3} : Point{-6, 1, X[1]};
  });
  a.rigid_shapes.push_back(stone("plate", Kind::box, {-0.5, -0.1, 0.5}, {"3", "1", "0"}));
  a.rigid_shapes.push_back(stone("ball", Kind::sphere, {0.45, 1.26, 0.5}, {"4", "-4", "0"}));
  a.rigid_shapes.push_back(stone("other", Kind::sphere, {0.45, 1.80, 0.45}, {"4", "-9", "0"}));
  a.rigid_shapes[1].angular_velocity = formulas({"0", "0", "9"});
  contact::TieRule joint, glue;
  joint.name = "joint";
  joint.bodies = {0, 1};
  joint.strength = 3e5;
  joint.toughness = 3e3;
  glue.name = "glue";
  glue.rigid = 0;
  a.ties = {joint, glue};
  a.contact.self = true;
  a.contact.friction.kinetic = 0.3;
  return a;
}

TEST(EverythingAtOnce, KeepsMomentaToRoundOffAndEnergy) {
  auto const f = make_formulation(everything());
  Diagnostics const before = f->diagnose();
  double time = 0, touched = 0, drift = 0, turned = 0;
  // 1100 kg/m3 of 1.0, 0.73 and 0.78 m3 and 900 kg of stones, at speeds up to 9 m/s and within 2.5 m.
  double const size = 3600 * 6, arm = 2.5;
  bool balls = false, bodies = false, on_ball = false;
  for (int k = 0; k < 700; ++k) {
    double const dt = f->stable_time_step();
    f->step(time, dt);
    time += dt;
    Diagnostics const d = f->diagnose();
    touched = std::max(touched, column(d, "contact_points"));
    for (std::size_t c = 0; c < 3; ++c) {
      drift = std::max(drift, std::fabs(d.linear_momentum[c] - before.linear_momentum[c]) / size);
      turned = std::max(turned, std::fabs(d.angular_momentum[c] - before.angular_momentum[c]) / (size * arm));
    }
    for (Action const& action : d.actions) {
      bool const acts = std::fabs(action.force[0]) + std::fabs(action.force[1]) > 1;
      balls = balls || (action.name == "other" && acts);
      on_ball = on_ball || (action.name == "ball" && acts);
      bodies = bodies || (action.name == "block 1-block 2" && acts);
    }
  }
  Diagnostics const d = f->diagnose();
  ASSERT_FALSE(f->failure().has_value());
  EXPECT_TRUE(balls && bodies && on_ball) << balls << bodies << on_ball << " each of them must have met";
  EXPECT_GT(column(d, "friction_heat"), 0);
  EXPECT_GT(column(d, "tie_dissipation"), 0);
  EXPECT_GT(column(d, "tie_energy"), 0);
  EXPECT_LT(drift, 1e-12);
  EXPECT_LT(turned, 1e-12);
  double const energy = d.total_energy() + column(d, "friction_heat") + column(d, "chatter_damping_loss") +
                        column(d, "tie_dissipation") + d.stabilisation_loss + d.projection_loss;
  EXPECT_NEAR(energy / before.total_energy(), 1, 1e-3);
}

TEST(EverythingAtOnce, ResumesBitForBitOnAnyNumberOfThreads) {
  Assembly const a = everything();
  auto const run = [](Formulation& f, double& time, int steps) {
    for (int k = 0; k < steps; ++k) {
      double const dt = f.stable_time_step();
      f.step(time, dt);
      time += dt;
    }
  };
  expect_same_on_threads(a, [&](Formulation& f, double& t) { run(f, t, 60); });
  auto const whole = make_formulation(a);
  double time = 0;
  run(*whole, time, 100);
  expect_resumes(a, *whole, time, [&](Formulation& f, double& t) { run(f, t, 40); });
}

}  // namespace
}  // namespace piola
