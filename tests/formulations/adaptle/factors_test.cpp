// SPDX-License-Identifier: Apache-2.0
// What a case adds to the law of each particle: scatter, explosives, glass. Runs are the same however they are cut.
#include "formulations/adaptle/clouds.hpp"
#include <cmath>

namespace piola {
namespace {

using namespace testing;

/// A metal that tears, each particle at its own strain.
MaterialParameters off_lattice() {
  return parameters_by_name("perfectly_plastic", "elastic", "johnson_cook",
                            {{"density", 2700},
                             {"youngs_modulus", 70e9},
                             {"poissons_ratio", 0.33},
                             {"yield_stress", 3e8},
                             {"d1", 0.02},
                             {"spall_pressure", 2e9},
                             {"weibull_modulus", 4}});
}
MaterialParameters glass() { return sample_metal("johnson_holmquist", "polynomial"); }
MaterialParameters explosive() {
  return parameters_by_name("elastic", "jwl", "",
                            {{"density", 1717},
                             {"youngs_modulus", 1e6},
                             {"poissons_ratio", 0.2},
                             {"jwl_a", 524.2e9},
                             {"jwl_b", 7.678e9},
                             {"jwl_r1", 4.2},
                             {"jwl_r2", 1.1},
                             {"jwl_omega", 0.34},
                             {"detonation_energy", 8.5e9},
                             {"detonation_speed", 7980}});
}

struct Subject {
  char const* name;
  MaterialParameters (*material)();
  double stretch;  ///< rate at the start [1/s]
  char const* ignition;
};

Assembly made(Subject const& subject) {
  Assembly a = adaptle_assembly(unit_box(2, 10, 0.1), subject.material());
  choose(a, "description", "adaptive");
  double const rate = subject.stretch;
  give_velocity(a, [rate](Point const& X) { return Point{rate * (X[0] - 0.5), 0.3 * rate * X[1], 0}; });
  if (*subject.ignition != 0) choose_formula(a, "ignition", subject.ignition);
  return a;
}

class PointFactorRuns : public ::testing::TestWithParam<Subject> {};

TEST_P(PointFactorRuns, GoOnFromACheckpointAsIfTheyHadNotStopped) {
  Assembly const a = made(GetParam());
  auto const whole = make_formulation(a), resumed = make_formulation(a);
  double const middle = take_steps(*whole, 0, 25);
  SavedState state = saved(*whole);
  resumed->load(state);
  take_steps(*whole, middle, 25);
  take_steps(*resumed, middle, 25);
  EXPECT_EQ(saved(*whole).values, saved(*resumed).values);
}

TEST_P(PointFactorRuns, AreTheSameWithAnyNumberOfThreads) {
  Assembly const a = made(GetParam());
  std::map<std::string, Values, std::less<>> first;
  for (int const threads : testing::thread_counts) {
    Threads const set(threads);
    auto const f = make_formulation(a);
    take_steps(*f, 0, 40);
    if (threads == 1) first = saved(*f).values;
    EXPECT_EQ(saved(*f).values, first) << threads;
  }
}

TEST_P(PointFactorRuns, KeepTheirEnergy) {
  Assembly const a = made(GetParam());
  auto const f = make_formulation(a);
  double const before = f->diagnose().total_energy();
  ASSERT_GT(before, 0);
  take_steps(*f, 0, 150);
  EXPECT_NEAR(f->diagnose().total_energy(), before, 5e-3 * before);
}

INSTANTIATE_TEST_SUITE_P(All, PointFactorRuns,
                         ::testing::Values(Subject{"scatter", &off_lattice, 400, ""},
                                           Subject{"glass", &glass, -3000, ""},
                                           Subject{"explosive", &explosive, 0, "X/7980"}),
                         [](auto const& subject) { return subject.param.name; });

TEST(PointFactors, LetParticlesFailOneAfterTheOther) {
  Assembly const a = made({"", &off_lattice, 400, ""});
  auto const f = make_formulation(a);
  double last = 0;
  int rises = 0;
  double time = 0;
  for (int k = 0; k < 40; ++k) {
    time = take_steps(*f, time, 10);
    double failed = 0;
    for (double const d : sample(*f, "Damage", a.particles.X.size())) failed += d >= 1 ? 1 : 0;
    rises += failed > last ? 1 : 0;
    last = failed;
  }
  EXPECT_GT(last, 5);
  EXPECT_GT(rises, 3);
}

/// The front goes through the charge with its speed. What its foot compresses burns by that, a little.
TEST(PointFactors, BurnAChargeFromWhereItIsLit) {
  Assembly a = made({"", &explosive, 0, "X/7980"});
  auto const f = make_formulation(a);
  double time = 0;
  while (time < 0.5 / 7980) time = take_steps(*f, time, 1);
  Values const p = sample(*f, "Pressure", a.particles.X.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (a.particles.X[i][0] > 0.75) {
      EXPECT_NEAR(p[i], 0, 1e8) << a.particles.X[i][0];
    }
    if (a.particles.X[i][0] < 0.25) {
      EXPECT_LT(p[i], -1e9) << a.particles.X[i][0];  // negative in compression
    }
  }
}

/// Two particles that see each other's volume grow would else run away in finite time, and the step with them.
TEST(EulerianDensity, StopsWhereAParticleFillsItsKernel) {
  Assembly a = adaptle_assembly(unit_box(3, 5));
  choose(a, "description", "eulerian");
  give_velocity(a, [](Point const& X) { return Point{1e4 * X[0], 1e4 * X[1], 1e4 * X[2]}; });
  Cloud cloud(a);
  double const rho0 = cloud.system().body[0].rho0, least = rho0 / (4 * std::acos(-1.0) / 3 * std::pow(2.4, 3));
  for (Index i = 0; i < cloud.size(); ++i) cloud.state[i].rho = 1.001 * least;
  cloud.changed();
  double time = 0;
  for (int k = 0; k < 5; ++k) {
    cloud.particles->step(time, 1e-6);
    time += 1e-6;
  }
  int at_least = 0;
  for (Index i = 0; i < cloud.size(); ++i) {
    EXPECT_GE(cloud.state[i].rho, least * (1 - 1e-12));
    at_least += std::abs(cloud.state[i].rho - least) < 1e-12 * rho0 ? 1 : 0;
  }
  EXPECT_GT(at_least, cloud.size() / 2);
}

}  // namespace
}  // namespace piola
