// SPDX-License-Identifier: Apache-2.0
// Runs that stop and go on, with any number of threads and any machine.
#include "formulations/adaptle/clouds.hpp"

namespace piola {
namespace {

using namespace testing;

/// Two plates that meet at 400 m/s; the left one tears as it goes.
Assembly collision(int dimension, std::string const& correction, std::string const& backend, double gap) {
  ParticleSet set = unit_box(dimension, dimension == 2 ? 12 : 6, 0.1);
  ShapeSpec shape;
  shape.dimension = dimension;
  double const spacing = dimension == 2 ? 1.0 / 11 : 1.0 / 5;
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) {
    shape.min[c] = c == 0 ? 1 + gap * spacing : 0.1;
    shape.max[c] = shape.min[c] + 6 * spacing * (c == 0 ? 0.5 : 1);
    shape.particles[c] = c == 0 ? 4 : 7;
  }
  fill(shape, "target", set);
  Assembly a = adaptle_assembly(std::move(set), sample_metal("johnson_cook", "mie_grueneisen", "johnson_cook"));
  a.backend = backend;
  choose(a, "correction", correction);
  choose(a, "conversion_radius", 1.0);
  choose_formula(a, "convert_when", dimension == 2 ? "X + 0.2*Y > 1.1 - 1.2e4*t" : "X + 0.2*Y + 0.1*Z > 1.3 - 5e3*t");
  give_velocity(a, [](Point const& X) { return Point{X[0] < 1.01 ? 400 + 100 * X[1] : 0.0, 60 * X[0] * X[1], 0}; });
  Load l;
  l.particles = select(a, everywhere);
  l.factor.assign(l.particles.size(), 1);
  l.value = formulas({"0", "-1e5*(1 + t)", "0"});
  a.loads.push_back(l);
  RigidShape floor;
  floor.axis = {0, 1, 0};
  floor.centre = {0, -0.55 * spacing, 0};
  floor.velocity[1] = Expression("10 + 1e4*t");
  a.rigid_shapes.push_back(floor);
  return a;
}

double number(Formulation const& f, std::string_view name) {
  for (auto const& [key, value] : f.diagnose().more)
    if (key == name) return value;
  ADD_FAILURE() << name;
  return 0;
}

class AdaptleRuns : public ::testing::TestWithParam<std::tuple<int, std::string>> {
 protected:
  Assembly assembly(std::string const& backend = "auto", double gap = 1.5) const {
    return collision(std::get<0>(GetParam()), std::get<1>(GetParam()), backend, gap);
  }
};

TEST_P(AdaptleRuns, GoOnFromACheckpointAsIfTheyHadNotStopped) {
  Assembly const a = assembly();
  auto const whole = make_formulation(a);
  double const middle = take_steps(*whole, 0, 12);
  double const converted = number(*whole, "eulerian_particles");
  SavedState state = saved(*whole);
  auto const resumed = make_formulation(a);
  resumed->load(state);
  EXPECT_EQ(saved(*resumed).values, state.values);
  EXPECT_EQ(resumed->stable_time_step(), whole->stable_time_step());
  take_steps(*whole, middle, 15);
  take_steps(*resumed, middle, 15);
  EXPECT_GT(converted, 0) << "the test has no conversion before the checkpoint";
  EXPECT_GT(number(*whole, "eulerian_particles"), converted) << "the test has none after it";
  SavedState const left = saved(*whole), right = saved(*resumed);
  for (auto const& [name, values] : left.values) EXPECT_EQ(values, right.values.at(name)) << name;
  for (auto const& field : whole->observables().fields())
    EXPECT_EQ(sample(*whole, field.name, a.particles.X.size()), sample(*resumed, field.name, a.particles.X.size()))
        << field.name;
}

TEST_P(AdaptleRuns, AreTheSameWithAnyNumberOfThreads) {
  Assembly const a = assembly();
  std::map<std::string, Values, std::less<>> first;
  for (int const threads : testing::thread_counts) {
    Threads const set(threads);
    ASSERT_EQ(exec::team_size(Range{0, static_cast<Index>(a.particles.X.size())}), threads);
    auto const f = make_formulation(a);
    take_steps(*f, 0, 25);
    if (threads == 1) first = saved(*f).values;
    EXPECT_EQ(saved(*f).values, first) << threads;
  }
}

TEST_P(AdaptleRuns, AgreeOnAllMachines) {
  Values x, v, p;
  for (auto const& backend : adaptle_machines()) {
    Assembly const a = assembly(backend);
    std::size_t const n = a.particles.X.size();
    auto const f = make_formulation(a);
    // The same steps on each.
    advance(*f, 2e-6, 20);
    ASSERT_FALSE(f->failure());
    Values const here = sample(*f, "Position", n), speed = sample(*f, "Velocity", n),
                 pressure = sample(*f, "Pressure", n);
    if (x.empty()) {
      x = here;
      v = speed;
      p = pressure;
    }
    EXPECT_LT(largest_difference(here, x), 1e-10) << backend;
    EXPECT_LT(largest_difference(speed, v), 1e-10 * largest(v)) << backend;
    EXPECT_LT(largest_difference(pressure, p), 1e-10 * largest(p)) << backend;
  }
}

TEST_P(AdaptleRuns, KeepTheirBooks) {
  Assembly const a = assembly("auto", 3);  // a gap of 3: no contact energy at the start
  auto const f = make_formulation(a);
  Diagnostics const before = f->diagnose();
  double const time = take_steps(*f, 0, 300);
  Diagnostics const after = f->diagnose();
  double const scale = before.kinetic_energy;
  EXPECT_NEAR(after.total_energy() - after.external_work, before.total_energy(), 5e-3 * scale) << time;
  EXPECT_LT(number(*f, "conversion_energy_change"), 1e-14 * scale);
  EXPECT_LT(number(*f, "conversion_momentum_change"), 1e-14 * scale);
  EXPECT_GT(number(*f, "eulerian_particles"), 0);
  EXPECT_GE(number(*f, "plastic_work"), 0);
}

INSTANTIATE_TEST_SUITE_P(All, AdaptleRuns,
                         ::testing::Combine(::testing::Values(2, 3), ::testing::Values("none", "mixed")));

TEST(AdaptleSolver, TellsOfABodyThatIsInverted) {
  Assembly a = adaptle_assembly(unit_box(2, 7));
  choose(a, "description", "total_lagrangian");
  displace(a, [](Point const& X) { return Point{-2 * X[0], 0, 0}; });
  auto const f = make_formulation(a);
  ASSERT_TRUE(f->failure()) << "rates are asked for before the first step";
  EXPECT_EQ(f->failure()->what, "is inverted");
  EXPECT_EQ(f->failure()->body, "box");
}

/// Whatever becomes of a particle, steps end, and what is not finite is a failure.
TEST(AdaptleSolver, ComesToAnEndWithAParticleThatFliesOff) {
  for (int const dimension : {2, 3})
    for (double const speed : {1e12, 1e25, 1e30, 1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
      Assembly a = collision(dimension, "none", "auto", 1.5);
      a.initial_velocity[3] = {-speed, speed, 0};
      auto const f = make_formulation(a);
      for (int k = 0; k < 3 && !f->failure(); ++k) f->step(1e-6 * k, 1e-6);
      EXPECT_TRUE(speed < 1e30 || f->failure()) << speed;
    }
}

TEST(AdaptleSolver, HoldsSupportsAndCountsTheirWork) {
  Assembly a = adaptle_assembly(unit_box(2, 9));
  support(a, {true, true, false}, [](Point const& X) { return X[0] < 0.01; });
  support(a, {true, false, false}, [](Point const& X) { return X[0] > 0.99; }).velocity = formulas({"50", "0", "0"});
  auto const f = make_formulation(a);
  double const time = take_steps(*f, 0, 40);
  Values const u = sample(*f, "Displacement", 81);
  for (std::size_t k = 0; k < 81; ++k) {
    if (a.particles.X[k][0] < 0.01) {
      EXPECT_EQ(u[3 * k], 0);
      EXPECT_EQ(u[3 * k + 1], 0);
    }
    // At rest at the start, it takes half of the first step to pick up its speed.
    if (a.particles.X[k][0] > 0.99) {
      EXPECT_NEAR(u[3 * k], 50 * time, 50 * time * 0.02);
    }
  }
  Diagnostics const d = f->diagnose();
  EXPECT_GT(d.external_work, 0);
  EXPECT_NEAR(d.total_energy(), d.external_work, 0.01 * d.external_work);
}

TEST(AdaptleSolver, AcceleratesByLoadsUntilTheyEnd) {
  Assembly a = adaptle_assembly(unit_box(3, 4));
  Load& l = load(a, {"0", "3e4", "0"}, everywhere);
  l.until = 1e-4;
  auto const f = make_formulation(a);
  double time = 0;
  while (time < 1.5e-4) {
    double const dt = f->stable_time_step();
    f->step(time, dt);
    time += dt;
  }
  Values const v = sample(*f, "Velocity", 64);
  for (std::size_t k = 0; k < 64; ++k) EXPECT_NEAR(v[3 * k + 1], 3, 1e-9);
  EXPECT_NEAR(f->diagnose().kinetic_energy, 0.5 * 2870 * 9, 1e-5);
  EXPECT_NEAR(f->diagnose().external_work, f->diagnose().kinetic_energy, 1e-5);
}

}  // namespace
}  // namespace piola
