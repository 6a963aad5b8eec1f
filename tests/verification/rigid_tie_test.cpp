// SPDX-License-Identifier: Apache-2.0
#include "verification/surface_bodies.hpp"

/// Bodies that are tied to rigid shapes: momenta, energy, forces, failure, threads, checkpoints.
namespace piola {
namespace {

using namespace testing;
using Kind = RigidShape::Kind;

struct Glued {
  std::string name, formulation;
  int dimension;
};

class GluedToRigid : public ::testing::TestWithParam<Glued> {
 protected:
  /// A unit block with a plate under it, of twice its mass where it is free.
  static Assembly scene(bool free, double strength = 0) {
    int const D = GetParam().dimension;
    Assembly a;
    add_block(a, D, GetParam().formulation, {}, 5, 0.2);
    RigidShape plate;
    plate.name = "plate";
    plate.kind = Kind::box;
    plate.half_lengths = {0.7, 0.1, 0.7};
    plate.centre = {0.5, -0.1, D == 3 ? 0.5 : 0};
    plate.velocity = formulas({"0", "0", "0"});
    plate.angular_velocity = formulas({"0", "0", "0"});
    plate.free = free;
    plate.mass = free ? 2 * density() : 0;
    a.rigid_shapes.push_back(plate);
    contact::TieRule tie;
    tie.name = "glue";
    tie.rigid = 0;
    tie.strength = strength;
    tie.toughness = (solid() ? 2e-4 : 0.02) * strength;
    a.ties.push_back(tie);
    if (solid()) {
      a.contact.law = ContactRule::Law::surface;
      a.cfl = 0.07;  // its energy is that of steps
    }
    return a;
  }
  static bool solid() { return GetParam().formulation == "adaptle"; }
  static double density() { return solid() ? 7800 : 1100; }
  static double weak() { return solid() ? 8e7 : 4e5; }
  static void run(Formulation& f, double& time, int steps) {
    for (int k = 0; k < steps && !f.failure(); ++k) {
      double const dt = f.stable_time_step();
      f.step(time, dt);
      time += dt;
    }
    ASSERT_FALSE(f.failure().has_value());
  }
};

TEST_P(GluedToRigid, AFreeShapeSharesMomentaAndEnergy) {
  for (double const strength : {0.0, weak()}) {
    Assembly a = scene(true, strength);
    a.rigid_shapes[0].velocity = formulas({"1", "-3", "0"});
    a.rigid_shapes[0].angular_velocity =
        formulas({GetParam().dimension == 3 ? "2" : "0", "0", GetParam().dimension == 3 ? "-1" : "2"});
    give_velocity(a, [](Point const& X) { return Point{-2 * X[1], 3 * X[0], 0}; });
    auto const f = make_formulation(a);
    Diagnostics const before = f->diagnose();
    double time = 0, size = 3 * density() * 4, stored = 0, heat = 0;
    for (int k = 0; k < 400; ++k) {
      run(*f, time, 1);
      Diagnostics const d = f->diagnose();
      stored = std::max(stored, column(d, "tie_energy"));
      heat = column(d, "tie_dissipation");
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_NEAR(d.linear_momentum[c], before.linear_momentum[c], 1e-12 * size);
        ASSERT_NEAR(d.angular_momentum[c], before.angular_momentum[c], (solid() ? 1e-6 : 1e-11) * size);
      }
    }
    Diagnostics const d = f->diagnose();
    EXPECT_GT(stored, 0);
    EXPECT_EQ(heat > 0, strength > 0);
    double const energy = d.total_energy() + heat + column(d, "friction_heat") + d.stabilisation_loss;
    EXPECT_NEAR(energy / before.total_energy(), 1, 6e-3) << strength;
  }
}

TEST_P(GluedToRigid, AFixedShapeHolds) {
  Assembly const a = [] {
    Assembly s = scene(false);
    give_velocity(s, [](Point const& X) { return Point{X[1], 2 * X[1], 0}; });
    return s;
  }();
  auto const f = make_formulation(a);
  double const start = f->diagnose().total_energy();
  double time = 0;
  run(*f, time, 400);
  Values const u = sample(*f, "Displacement", static_cast<std::size_t>(a.particles.size()));
  for (std::int64_t id = 0; id < a.particles.size(); ++id) {
    if (a.particles.X[static_cast<std::size_t>(id)][1] > 0.2) continue;
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(u[3 * static_cast<std::size_t>(id) + c], 0, 0.05);
  }
  Diagnostics const d = f->diagnose();
  EXPECT_NEAR((d.total_energy() + d.stabilisation_loss) / start, 1, 6e-3);
  EXPECT_EQ(column(d, "contact_points"), 0) << "what is held is not pushed";
}

// The work of what drives a shape is external work, and the force in history that on the body.
TEST_P(GluedToRigid, ADrivenShapeDoesWork) {
  Assembly a = scene(false);
  a.rigid_shapes[0].velocity = formulas({"0.5*sin(40*t)", "-sin(40*t)", "0"});
  auto const f = make_formulation(a);
  double time = 0;
  Point impulse{};
  for (int k = 0; k < 300; ++k) {
    double const dt = f->stable_time_step();
    f->step(time, dt);
    time += dt;
    Action const& glue = f->diagnose().actions.back();
    ASSERT_EQ(glue.name, "glue");
    for (std::size_t c = 0; c < 3; ++c) {
      impulse[c] += dt * glue.force[c];
      EXPECT_NEAR(f->diagnose().actions.front().force[c], glue.force[c], 1e-9 * (1 + std::fabs(glue.force[c])));
    }
  }
  Diagnostics const d = f->diagnose();
  double const moved = std::fabs(d.linear_momentum[1]);
  EXPECT_GT(d.external_work, 0);
  EXPECT_NEAR((d.total_energy() + d.stabilisation_loss) / d.external_work, 1, 1e-2);
  for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(impulse[c], d.linear_momentum[c], 1e-6 * moved);
}

TEST_P(GluedToRigid, TheForceIsThatOnWhatIsNamedFirst) {
  std::array<double, 3> force[2];
  for (bool const rigid_first : {false, true}) {
    Assembly a = scene(true);
    a.ties[0].rigid_first = rigid_first;
    give_velocity(a, [](Point const&) { return Point{0.3, 1, 0}; });
    auto const f = make_formulation(a);
    double time = 0;
    run(*f, time, 10);
    force[rigid_first ? 1 : 0] = f->diagnose().actions.back().force;
  }
  ASSERT_NE(force[0][1], 0);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(force[0][c], -force[1][c], 1e-12 * std::fabs(force[0][1]));
}

// Torn off, and pressed on again: it is pushed by contact then.
TEST_P(GluedToRigid, WhatFailedIsPushed) {
  Assembly a = scene(true, weak());
  a.rigid_shapes[0].velocity = formulas({"8", "1", "0"});
  give_velocity(a, [](Point const&) { return Point{-8, -1, 0}; });
  auto const f = make_formulation(a);
  double const start = f->diagnose().total_energy();
  double time = 0, touched = 0, overlap = 0;
  // Until 50 ms: the block then slides off the edge of the plate, which is thinner than a spacing.
  for (int k = 0; k < 600 && time < 0.05; ++k) {
    run(*f, time, 1);
    Diagnostics const d = f->diagnose();
    touched = std::max(touched, column(d, "contact_points"));
    overlap = std::max(overlap, column(d, "contact_overlap"));
  }
  Diagnostics const d = f->diagnose();
  EXPECT_GT(column(d, "tie_failed_fraction"), 0.9);
  EXPECT_GT(touched, 0);
  EXPECT_LT(overlap, 0.5);
  EXPECT_NEAR((d.total_energy() + column(d, "tie_dissipation") + d.stabilisation_loss) / start, 1, 2e-2);
}

TEST_P(GluedToRigid, SameBitsOnThreadsAndResumed) {
  Assembly a = scene(true, weak());
  a.rigid_shapes[0].velocity = formulas({"5", "-8", "0"});
  expect_same_on_threads(a, [](Formulation& f, double& t) { run(f, t, 100); });
  auto const whole = make_formulation(a);
  double time = 0;
  for (int k = 0; k < 400 && !(column(whole->diagnose(), "tie_dissipation") > 0); ++k) run(*whole, time, 1);
  ASSERT_GT(column(whole->diagnose(), "tie_dissipation"), 0);
  expect_resumes(a, *whole, time, [](Formulation& f, double& t) { run(f, t, 60); });
}

INSTANTIATE_TEST_SUITE_P(Bodies, GluedToRigid,
                         ::testing::Values(Glued{"nodal_2d", "nodal", 2}, Glued{"nodal_3d", "nodal", 3},
                                           Glued{"jst_3d", "jst_sph", 3}, Glued{"adaptle_2d", "adaptle", 2}),
                         [](auto const& at) { return at.param.name; });

}  // namespace
}  // namespace piola
