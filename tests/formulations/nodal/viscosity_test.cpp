// SPDX-License-Identifier: Apache-2.0
#include "formulations/nodal/nodal_bodies.hpp"

namespace piola::testing {
namespace {

Assembly tumbling(int dimension, double fluctuation, double shock) {
  Assembly a = tumbling_box(dimension, 5, 0.2);
  for (auto& f : a.formulations) f = {"nodal", {}, {}};
  choose(a, "fluctuation_viscosity", fluctuation);
  choose(a, "shock_viscosity", shock);
  return a;
}

TEST(NodalViscosity, OnlyTakesEnergyBooksItAndKeepsMomenta) {
  for (int D = 1; D <= 3; ++D) {
    double error[2];
    for (int half = 0; half < 2; ++half) {
      Assembly a = tumbling(D, 0.1, 1);
      a.cfl = half == 0 ? 0.05 : 0.025;
      auto const f = make_formulation(a);
      auto const start = f->diagnose();
      double time = 0, loss = 0;
      while (time < 0.02) {
        double const dt = std::min(f->stable_time_step(), 0.02 - time);
        f->step(time, dt);
        time += dt;
        double const now = f->diagnose().stabilisation_loss;
        EXPECT_GE(now, loss * (1 - 1e-12));
        loss = now;
      }
      auto const end = f->diagnose();
      EXPECT_GT(loss, 1e-3 * end.kinetic_energy);
      error[half] = std::fabs(end.total_energy() + loss - start.total_energy()) / start.total_energy();
      double const scale = std::sqrt(2 * start.kinetic_energy * 1100);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(end.linear_momentum[c], start.linear_momentum[c], 1e-11 * scale);
        EXPECT_NEAR(end.angular_momentum[c], start.angular_momentum[c], 1e-11 * scale);
      }
    }
    EXPECT_LT(error[0], 2e-3) << D;
    EXPECT_LT(error[1], 0.4 * error[0]) << D;
  }
}

/// Accelerations after one step from rest of the shape, with the velocity A X.
Values after_a_step(Mat<3> const& A, double fluctuation, double shock) {
  Assembly a = nodal_body(brick(3, 0.3));
  choose(a, "fluctuation_viscosity", fluctuation);
  choose(a, "shock_viscosity", shock);
  give_velocity(a, [&](Point const& X) {
    Point v{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t J = 0; J < 3; ++J) v[i] += A(static_cast<int>(i), static_cast<int>(J)) * X[J];
    return v;
  });
  a.cfl = 0.3;
  auto const f = make_formulation(a);
  f->step(0, f->stable_time_step());
  return saved(*f).values.at("body0_acceleration");
}

TEST(NodalViscosity, LeavesRotationAndUniformRatesAlone) {
  Mat<3> turn{}, pull{};
  turn(0, 1) = -80;
  turn(1, 0) = 80;
  pull(0, 0) = 40;
  pull(1, 2) = 30;
  for (auto const& A : {turn, pull}) {
    auto const plain = after_a_step(A, 0, 0);
    EXPECT_LT(largest_difference(after_a_step(A, 0.2, 1), plain), 1e-9 * largest(plain));
  }
  pull(0, 0) = -40;
  EXPECT_GT(largest_difference(after_a_step(pull, 0, 1), after_a_step(pull, 0, 0)), 0.01);
}

TEST(NodalViscosity, GoesOnBitForBitFromACheckpoint) {
  Assembly const a = tumbling(3, 0.1, 1);
  auto const whole = make_formulation(a), first = make_formulation(a), second = make_formulation(a);
  advance_by_itself(*whole, 0, 60);
  double const middle = advance_by_itself(*first, 0, 31);
  auto state = saved(*first);
  second->load(state);
  advance_by_itself(*second, middle, 29);
  EXPECT_EQ(saved(*second).values, saved(*whole).values);
}

}  // namespace
}  // namespace piola::testing
