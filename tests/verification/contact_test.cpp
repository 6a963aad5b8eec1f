// SPDX-License-Identifier: Apache-2.0
#include "verification/surface_bodies.hpp"

/// Bodies of any formulations that meet: momenta, energy, forces, threads, checkpoints.
namespace piola {
namespace {

using namespace testing;

struct Meeting {
  std::string name;
  std::string left, right;  ///< formulations
  int dimension;
};

class SurfaceContact : public ::testing::TestWithParam<Meeting> {
 protected:
  /// Two blocks of different spacing that meet off their middles and turn each other.
  static Assembly blocks(double friction = 0) {
    Assembly a;
    add_block(a, GetParam().dimension, GetParam().left, {-1.02, 0, 0}, 4, 0.25);
    add_block(a, GetParam().dimension, GetParam().right, {0, 0.3, GetParam().dimension == 3 ? 0.2 : 0}, 5, 0.18);
    a.contact.friction.kinetic = friction;
    give_velocity(a, [](Point const& X) { return X[0] < -0.01 ? Point{4, 0.5, 0} : Point{-3, 0, 0}; });
    return a;
  }
  /// Steps of the formulation's own choice.
  static double run(Formulation& f, double& time, int steps) {
    double deepest = 0;
    for (int k = 0; k < steps && !f.failure(); ++k) {
      double const dt = f.stable_time_step();
      f.step(time, dt);
      time += dt;
      deepest = std::max(deepest, column(f.diagnose(), "contact_overlap"));
    }
    EXPECT_FALSE(f.failure().has_value());
    return deepest;
  }
};

TEST_P(SurfaceContact, KeepsMomentaAndEnergy) {
  for (double const friction : {0.0, 0.4}) {
    auto const f = make_formulation(blocks(friction));
    Diagnostics const before = f->diagnose();
    double time = 0, energy = 0;
    int touched = 0;
    bool const adaptle = GetParam().left == "adaptle";
    double const size = 1100 * 4 * 2, energy_size = before.kinetic_energy;
    for (int k = 0; k < 400; ++k) {
      double const dt = f->stable_time_step();
      f->step(time, dt);
      time += dt;
      Diagnostics const d = f->diagnose();
      touched += column(d, "contact_points") > 0 ? 1 : 0;
      energy = d.total_energy() + column(d, "friction_heat") + d.stabilisation_loss;
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_NEAR(d.linear_momentum[c], before.linear_momentum[c], 1e-11 * size);
        ASSERT_NEAR(d.angular_momentum[c], before.angular_momentum[c], (adaptle ? 1e-9 : 1e-10) * size);
      }
    }
    EXPECT_GT(touched, 5) << "they met";
    EXPECT_NEAR(energy / energy_size, before.total_energy() / energy_size, 6e-3);
  }
}

TEST_P(SurfaceContact, StopsBodiesBeforeTheyEnter) {
  auto const f = make_formulation(blocks());
  double time = 0;
  EXPECT_LT(run(*f, time, 300), 0.4);
}

TEST_P(SurfaceContact, HasTheSameBitsWithAnyNumberOfThreads) {
  Values first;
  for (int const threads : thread_counts) {
    Threads const shared(threads);
    Assembly const a = blocks(0.3);
    auto const f = make_formulation(a);
    double time = 0;
    run(*f, time, 60);
    Values const v = sample(*f, "Velocity", static_cast<std::size_t>(a.particles.size()));
    if (first.empty()) first = v;
    EXPECT_EQ(v, first) << threads;
  }
}

TEST_P(SurfaceContact, ResumesBitForBit) {
  Assembly const a = blocks(0.3);
  auto const whole = make_formulation(a);
  double time = 0;
  for (int k = 0; k < 5 || (column(whole->diagnose(), "contact_points") == 0 && k < 300); ++k) run(*whole, time, 1);
  run(*whole, time, 3);
  ASSERT_GT(column(whole->diagnose(), "contact_points"), 0);
  expect_resumes(a, *whole, time, [](Formulation& f, double& t) { run(f, t, 30); });
}

// What everything that acts does is the rate of the momentum; a driven plane works.
TEST_P(SurfaceContact, ForcesOfShapesAndSupportsAreTheRateOfMomentum) {
  Assembly a = blocks(0.3);
  RigidShape plane;
  plane.name = "ram";
  plane.centre = {-1.03, 0, 0};
  plane.axis = {1, 0, 0};
  plane.velocity = formulas({"30", "0", "0"});
  a.rigid_shapes.push_back(plane);
  Support& wall = support(a, {true, true, true}, [](Point const& X) { return X[0] > 0.75; });
  wall.name = "wall";
  give_velocity(a, [](Point const&) { return Point{}; });
  if (GetParam().left == "adaptle") GTEST_SKIP() << "its own contact pushes it off the plane";
  auto const f = make_formulation(a);
  double time = 0, held = 0, work = 0;
  for (int k = 0; k < 100; ++k) {
    Diagnostics const before = f->diagnose();
    double const dt = f->stable_time_step();
    f->step(time, dt);
    time += dt;
    Diagnostics const d = f->diagnose();
    ASSERT_EQ(d.actions.size(), 3U);
    EXPECT_EQ(d.actions[0].name, "wall");
    EXPECT_EQ(d.actions[1].name, "ram");
    EXPECT_EQ(d.actions[2].name, "block 0-block 1");
    double const rate = (d.linear_momentum[0] - before.linear_momentum[0]) / dt;
    double const sum = d.actions[0].force[0] + d.actions[1].force[0];
    double const scale = std::max({std::fabs(rate), std::fabs(d.actions[1].force[0]), 1.0});
    EXPECT_NEAR(sum, rate, 1e-6 * scale) << k;
    held = std::min(held, d.actions[0].force[0]);
    work = d.external_work;
    if (k == 99) {
      EXPECT_NEAR((d.total_energy() + column(d, "friction_heat") + d.stabilisation_loss) / work, 1, 1e-2);
    }
  }
  EXPECT_GT(work, 0) << "of the ram";
  EXPECT_LT(held, 0) << "the push has come through both blocks";
}

INSTANTIATE_TEST_SUITE_P(Pairs, SurfaceContact,
                         ::testing::Values(Meeting{"nodal_2d", "nodal", "nodal", 2},
                                           Meeting{"nodal_3d", "nodal", "nodal", 3},
                                           Meeting{"jst_2d", "jst_sph", "jst_sph", 2},
                                           Meeting{"jst_nodal_3d", "jst_sph", "nodal", 3},
                                           Meeting{"adaptle_nodal_2d", "adaptle", "nodal", 2},
                                           Meeting{"adaptle_jst_3d", "adaptle", "jst_sph", 3}),
                         [](auto const& at) { return at.param.name; });

}  // namespace
}  // namespace piola
