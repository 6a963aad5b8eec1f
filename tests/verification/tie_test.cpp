// SPDX-License-Identifier: Apache-2.0
#include "verification/surface_bodies.hpp"

/// Bodies of any formulations that are tied: momenta, energy, forces, failure, threads, checkpoints.
namespace piola {
namespace {

using namespace testing;

struct Pair {
  std::string name;
  std::string lower, upper;  ///< formulations
  int dimension;
};

class TiedBodies : public ::testing::TestWithParam<Pair> {
 protected:
  /// Two blocks of different spacing, the right one on the left one, that turn and pull each other; without contact but
  /// for what fails.
  static Assembly stack(double strength = 0) {
    Assembly a;
    add_block(a, GetParam().dimension, GetParam().lower, {-1, 0, 0}, 4, 0.25);
    add_block(a, GetParam().dimension, GetParam().upper, {0, 0.1, GetParam().dimension == 3 ? 0.05 : 0}, 5, 0.18);
    contact::TieRule tie;
    tie.name = "glue";
    tie.bodies = {0, 1};
    if (strength > 0) {
      tie.strength = strength;
      tie.toughness = (a.formulations[0].name == "adaptle" ? 1e-4 : 0.01) * strength;  // it has failed at twice that
      tie.stiffness = 2;
    }
    a.ties.push_back(tie);
    double const pull = strength > 0 ? 8 : -3;
    give_velocity(a, [pull](Point const& X) { return X[0] < 0 ? Point{0, 4 * X[0], 0} : Point{pull, 3 * X[0], 0}; });
    return a;
  }
  static void run(Formulation& f, double& time, int steps) {
    for (int k = 0; k < steps && !f.failure(); ++k) {
      double const dt = f.stable_time_step();
      f.step(time, dt);
      time += dt;
    }
    EXPECT_FALSE(f.failure().has_value());
  }
  /// Of a tie that fails in part of these runs [Pa].
  static double weak() { return GetParam().lower == "adaptle" ? 4e7 : 4e5; }
};

TEST_P(TiedBodies, KeepMomentaAndEnergy) {
  for (double const strength : {0.0, weak()}) {
    Assembly a = stack(strength);
    // Its energy is that of steps.
    if (GetParam().upper == "adaptle") a.cfl = 0.15;
    auto const f = make_formulation(a);
    Diagnostics const before = f->diagnose();
    double time = 0, largest = 0;
    bool const adaptle = GetParam().lower == "adaptle";
    // A block of adaptle that vibrates turns a little by itself.
    double const size = (adaptle ? 7800 : 1100) * 8 * 4;
    for (int k = 0; k < 300; ++k) {
      run(*f, time, 1);
      Diagnostics const d = f->diagnose();
      largest = std::max(largest, column(d, "tie_energy"));
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_NEAR(d.linear_momentum[c], before.linear_momentum[c], 1e-12 * size);
        ASSERT_NEAR(d.angular_momentum[c], before.angular_momentum[c], (adaptle ? 1e-6 : 1e-10) * size);
      }
    }
    EXPECT_GT(largest, 0);
    Diagnostics const after = f->diagnose();
    double const energy = after.total_energy() + column(after, "tie_dissipation") + column(after, "friction_heat") +
                          after.stabilisation_loss;
    EXPECT_NEAR(energy / before.kinetic_energy, before.total_energy() / before.kinetic_energy, 8e-3);
    if (strength > 0)
      EXPECT_GT(column(after, "tie_failed_fraction"), 0.1);
    else
      EXPECT_EQ(column(after, "tie_dissipation"), 0);
  }
}

TEST_P(TiedBodies, StayTogetherWithoutContact) {
  if (GetParam().upper == "adaptle") GTEST_SKIP() << "bodies of adaptle that merge need one spacing";
  Assembly a = stack();
  a.contact.law = ContactRule::Law::none;
  give_velocity(a, [](Point const& X) { return X[0] < 0 ? Point{-1, 0, 0} : Point{1, 0, 0}; });
  auto const f = make_formulation(a);
  double time = 0, last = 0;
  for (int k = 0; k < 200; ++k) {
    run(*f, time, 1);
    last = std::max(last, std::sqrt(column(f->diagnose(), "tie_energy")));
  }
  auto const x = sample(*f, "Displacement", static_cast<std::size_t>(a.particles.size()));
  double apart = 0;
  for (std::size_t k = 0; k < x.size(); ++k) apart = std::max(apart, std::fabs(x[k]));
  EXPECT_LT(apart, GetParam().lower == "adaptle" ? 0.05 : 0.25);
  EXPECT_GT(last, 0);
  EXPECT_EQ(column(f->diagnose(), "contact_points"), 0);
}

TEST_P(TiedBodies, ShortenTheStep) {
  Assembly free = stack();
  free.ties.clear();
  auto const tied = make_formulation(stack()), loose = make_formulation(free);
  EXPECT_LT(tied->step_estimate().stable, loose->step_estimate().stable);
  EXPECT_LT(tied->stable_time_step(), loose->stable_time_step());
  EXPECT_NE(tied->step_estimate().limit.find("ties"), std::string::npos);
}

TEST_P(TiedBodies, ForceIsTheRateOfMomentum) {
  Assembly const a = stack();
  auto const f = make_formulation(a);
  double time = 0;
  run(*f, time, 20);
  auto const momentum = [](Diagnostics const& d) { return d.bodies[0].linear_momentum; };
  Diagnostics const before = f->diagnose();
  double const dt = f->stable_time_step();
  f->step(time, dt);
  Diagnostics const after = f->diagnose();
  Action const& glue = after.actions.back();
  EXPECT_EQ(glue.name, "glue");
  double size = 0;
  for (std::size_t c = 0; c < 3; ++c) size = std::max(size, std::fabs(glue.force[c]));
  for (std::size_t c = 0; c < 2; ++c)
    EXPECT_NEAR(glue.force[c], (momentum(after)[c] - momentum(before)[c]) / dt, 1e-6 * size);
}

TEST_P(TiedBodies, HaveTheSameBitsWithAnyNumberOfThreads) {
  Values first;
  for (int const threads : thread_counts) {
    Threads const shared(threads);
    Assembly const a = stack(weak());
    auto const f = make_formulation(a);
    double time = 0;
    run(*f, time, 120);
    EXPECT_GT(column(f->diagnose(), "tie_dissipation"), 0);
    Values const v = sample(*f, "Velocity", static_cast<std::size_t>(a.particles.size()));
    if (first.empty()) first = v;
    EXPECT_EQ(v, first) << threads;
  }
}

TEST_P(TiedBodies, ResumeBitForBitWhileTheyFail) {
  Assembly const a = stack(weak());
  auto const whole = make_formulation(a);
  double time = 0;
  for (int k = 0; k < 400 && !(column(whole->diagnose(), "tie_failed_fraction") > 0); ++k) run(*whole, time, 1);
  ASSERT_GT(column(whole->diagnose(), "tie_failed_fraction"), 0);
  SavedState state = saved(*whole);
  auto const resumed = make_formulation(a);
  resumed->load(state);
  EXPECT_EQ(resumed->diagnose().actions.back().force, whole->diagnose().actions.back().force);
  EXPECT_EQ(column(resumed->diagnose(), "tie_dissipation"), column(whole->diagnose(), "tie_dissipation"));
  expect_resumes(a, *whole, time, [](Formulation& f, double& t) { run(f, t, 60); });
}

// Torn off along the surface while they are pressed together: what has failed is pushed by contact instead.
TEST_P(TiedBodies, AreKeptApartWhereTheyFailed) {
  Assembly a = stack(weak());
  give_velocity(a, [](Point const& X) { return X[0] < 0 ? Point{1, -8, 0} : Point{-1, 8, 0}; });
  auto const f = make_formulation(a);
  double const start = f->diagnose().total_energy();
  double time = 0, touched = 0, overlap = 0, energy = start;
  for (int k = 0; k < 600; ++k) {
    run(*f, time, 1);
    Diagnostics const d = f->diagnose();
    touched = std::max(touched, column(d, "contact_points"));
    overlap = std::max(overlap, column(d, "contact_overlap"));
    energy = d.total_energy() + column(d, "tie_dissipation") + d.stabilisation_loss;
  }
  EXPECT_GT(column(f->diagnose(), "tie_failed_fraction"), 0.9);
  EXPECT_GT(touched, 0);
  EXPECT_LT(overlap, 0.3);
  EXPECT_NEAR(energy / start, 1, GetParam().upper == "adaptle" ? 2e-2 : 1e-2);
}

INSTANTIATE_TEST_SUITE_P(Pairs, TiedBodies,
                         ::testing::Values(Pair{"nodal_2d", "nodal", "nodal", 2}, Pair{"nodal_3d", "nodal", "nodal", 3},
                                           Pair{"jst_2d", "jst_sph", "jst_sph", 2},
                                           Pair{"jst_nodal_3d", "jst_sph", "nodal", 3},
                                           Pair{"adaptle_2d", "adaptle", "adaptle", 2},
                                           Pair{"adaptle_nodal_3d", "adaptle", "nodal", 3}),
                         [](auto const& at) { return at.param.name; });

}  // namespace
}  // namespace piola
