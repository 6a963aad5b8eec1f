// SPDX-License-Identifier: Apache-2.0
#include "formulations/nodal/nodal_bodies.hpp"

namespace piola::testing {
namespace {

constexpr double nu = 0.499;

/// A column of 4 x 13 x 4 particles, 4 m long, that swings about its foot.
Assembly column(std::string const& pressure, double jitter = 0,
                MaterialParameters const& m = rubber("neo_hookean", nu)) {
  ShapeSpec shape;
  shape.dimension = 3;
  shape.min = {-0.5, 0, -0.5};
  shape.max = {0.5, 4, 0.5};
  shape.particles = {4, 13, 4};
  shape.jitter = jitter;
  ParticleSet set;
  fill(shape, "column", set);
  Assembly a = nodal_body(std::move(set), m);
  choose(a, "pressure", pressure);
  give_velocity(a, [](Point const& X) { return Point{2.5 * X[1], 0, 0.5 * X[1]}; });
  support(a, {true, true, true}, [](Point const& X) { return X[1] < 1e-9; }).name = "foot";
  return a;
}

struct Motion {
  Diagnostics end;
  Values displacement;
  double energy_error = 0;  ///< largest, relative to the start
  int steps = 0;
};
Motion run(Assembly const& a, double until) {
  auto const f = make_formulation(a);
  Motion r;
  double const start = f->diagnose().total_energy();
  double time = 0;
  while (time < until) {
    double const dt = std::min(f->stable_time_step(), until - time);
    f->step(time, dt);
    time += dt;
    ++r.steps;
    if (r.steps % 5 != 0) continue;
    auto const d = f->diagnose();
    r.energy_error = std::max(r.energy_error, std::fabs(d.total_energy() - d.external_work - start) / start);
  }
  EXPECT_FALSE(f->failure());
  r.end = f->diagnose();
  r.displacement = sample(*f, "Displacement", a.particles.X.size());
  return r;
}

TEST(NodalImplicitPressure, MovesAsExplicitStepsDoInAFractionOfThem) {
  for (double const jitter : {0.0, 0.3}) {
    Motion const many = run(column("explicit", jitter), 0.2), few = run(column("implicit", jitter), 0.2);
    EXPECT_LT(8 * few.steps, many.steps) << jitter;
    EXPECT_LT(largest_difference(few.displacement, many.displacement), 0.01 * largest(many.displacement)) << jitter;
    EXPECT_LT(few.energy_error, 1e-3) << jitter;
  }
}

TEST(NodalImplicitPressure, TakesTheLawsWhoseEnergySplits) {
  MaterialParameters mooney = rubber("mooney_rivlin", nu);
  mooney.value[3] = 0.8;  // of c10
  for (auto const& m : {mooney, rubber("linear_elastic", nu)}) {
    Motion const many = run(column("explicit", 0, m), 0.05), few = run(column("implicit", 0, m), 0.05);
    EXPECT_LT(largest_difference(few.displacement, many.displacement), 0.02 * largest(many.displacement));
    EXPECT_LT(few.energy_error, 1e-3);
  }
}

// Angular momentum is kept as far as the predicted midpoint is the midpoint.
TEST(NodalImplicitPressure, KeepsMomentaOfATumblingBlock) {
  for (int D = 2; D <= 3; ++D) {
    Assembly a = tumbling_box(D, 5, 0.2);
    a.materials.assign(1, rubber("neo_hookean", nu));
    for (auto& f : a.formulations) f = {"nodal", {}, {{"pressure", "implicit"}}};
    auto const start = make_formulation(a)->diagnose();
    Motion const r = run(a, 0.05);
    double const scale = std::sqrt(2 * start.kinetic_energy * 1100);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(r.end.linear_momentum[c], start.linear_momentum[c], 1e-11 * scale);
      EXPECT_NEAR(r.end.angular_momentum[c], start.angular_momentum[c], 1e-3 * scale);
    }
    EXPECT_LT(r.energy_error, 3e-3) << D;
  }
}

// The pressure is a part of the reaction: the foot takes the momentum of the column, and a driven foot does its work.
TEST(NodalImplicitPressure, AddsToReactionsAndTheirWork) {
  Assembly a = column("implicit");
  a.initial_velocity.clear();
  a.supports[0].velocity = formulas({"0", "3*sin(40*t)", "0"});
  auto const f = make_formulation(a);
  double time = 0, impulse = 0;
  while (time < 0.06) {
    double const dt = f->stable_time_step();
    f->step(time, dt);
    time += dt;
    impulse += dt * f->diagnose().actions[0].force[1];
  }
  auto const d = f->diagnose();
  EXPECT_NEAR(d.external_work / d.total_energy(), 1, 2e-3);
  EXPECT_GT(std::fabs(d.linear_momentum[1]), 100);
}

TEST(NodalImplicitPressure, GoesOnBitForBitFromACheckpointAndOnThreads) {
  Assembly const a = column("implicit", 0.2);
  auto const whole = make_formulation(a), first = make_formulation(a), second = make_formulation(a);
  advance_by_itself(*whole, 0, 40);
  double const time = advance_by_itself(*first, 0, 20);
  SavedState state = saved(*first);
  second->load(state);
  advance_by_itself(*second, time, 20);
  auto const n = a.particles.X.size();
  EXPECT_EQ(sample(*whole, "Displacement", n), sample(*second, "Displacement", n));
  Threads const three(3);
  auto const threads = make_formulation(a);
  advance_by_itself(*threads, 0, 40);
  EXPECT_EQ(sample(*whole, "Displacement", n), sample(*threads, "Displacement", n));
}

// A cube has long rows, for which no factor is made.
TEST(NodalImplicitPressure, TakesBodiesThatAreNotSlender) {
  Assembly a = nodal_body(brick(3, 0, {14, 14, 14}), rubber("neo_hookean", nu));
  choose(a, "pressure", "implicit");
  give_velocity(a, [](Point const& X) { return Point{4 * X[1], -4 * X[0], X[2] * X[0]}; });
  Motion const r = run(a, 0.004);
  EXPECT_LT(r.energy_error, 1e-3);
}

TEST(NodalImplicitPressure, RefusesWhatItCannotDo) {
  Assembly law = column("implicit", 0, rubber("saint_venant_kirchhoff", 0.3));
  EXPECT_NE(refusal(law).find("whose energy splits"), std::string::npos);
  Assembly viscous = column("implicit");
  choose(viscous, "fluctuation_viscosity", 0.05);
  EXPECT_NE(refusal(viscous).find("no viscosity"), std::string::npos);
  Assembly mirrored = column("implicit");
  mirrored.supports.clear();
  mirrored.mirrors.push_back({.body = 0, .axis = 0, .upper = false});
  EXPECT_NE(refusal(mirrored).find("mirror planes"), std::string::npos);
}

}  // namespace
}  // namespace piola::testing
