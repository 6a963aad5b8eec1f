// SPDX-License-Identifier: Apache-2.0
// Solids in rate form under the nodal formulation.
#include "formulations/copper.hpp"
#include "formulations/nodal/nodal_bodies.hpp"
#include "support/key_words.hpp"
#include <fmt/format.h>

namespace piola::testing {
namespace {

using namespace metals;
using test::expect_words;

constexpr double mu = E / (2 * (1 + nu));

/// A brick that bends, stretches and turns, fast enough to yield.
Assembly tumbling(int dimension, std::string_view law = "isotropic_hardening", double jitter = 0.1) {
  Assembly a = nodal_body(brick(dimension, jitter, {5, 5, 6}), copper(law));
  give_velocity(a, [&](Point const& X) {
    return Point{90 * std::sin(2 * X[0]) - 40 * X[1], dimension > 1 ? 80 * X[0] * X[1] + 40 * X[0] : 0,
                 dimension > 2 ? 60 * X[0] * X[2] : 0};
  });
  return a;
}
constexpr double dt = 2e-6;

double plastic_strain(Formulation const& f, Assembly const& a) {
  return largest(sample(f, "EquivalentPlasticStrain", a.particles.X.size()));
}
double column(Diagnostics const& d, std::string_view wanted) {
  for (auto const& [name, value] : d.more)
    if (name == wanted) return value;
  ADD_FAILURE() << "no column is named " << wanted;
  return 0;
}

/// All particles driven along x = X exp(k t), the others so that the volume stays.
std::unique_ptr<Formulation> stretched(int dimension, MaterialParameters const& m, double rate, double end, int steps) {
  Assembly a = nodal_body(brick(dimension, 0.1), m);
  double const across = dimension == 3 ? -0.5 * rate : -rate;
  give_velocity(a, [&](Point const& X) { return Point{rate * X[0], across * X[1], across * X[2]}; });
  auto const along = [&](char axis, double k) { return fmt::format("{0}*({1})*exp({0}*t)", k, axis); };
  support(a, {true, true, true}, everywhere).velocity =
      formulas({along('X', rate), along('Y', across), along('Z', across)});
  auto f = make_formulation(a);
  for (int k = 0; k < steps; ++k) f->step(k * end / steps, end / steps);
  EXPECT_FALSE(f->failure().has_value());
  return f;
}

/// Without rotation the deviator keeps its direction: with the logarithmic strain e along the axis the von Mises stress
/// is 3 mu e, and after yield that of the plastic strain e - q / (3 mu).
TEST(NodalSolids, HardenInTensionAsTheLawSays) {
  constexpr double strain = 0.3, rate = 1000;
  auto const f = stretched(3, copper(), rate, strain / rate, 300);
  std::size_t const n = 4 * 5 * 6;
  double const mises = (yield + hardening * strain) / (1 + hardening / (3 * mu)), plastic = strain - mises / (3 * mu);
  for (double const q : sample(*f, "VonMisesStress", n)) ASSERT_NEAR(q, mises, 1e-4 * mises);
  for (double const ep : sample(*f, "EquivalentPlasticStrain", n)) ASSERT_NEAR(ep, plastic, 1e-4 * plastic);
  for (double const p : sample(*f, "CellPressure", n)) ASSERT_NEAR(p, 0, 1e-3 * mises);
}

/// The same in plane strain, where the von Mises stress of pure shear is 2 sqrt(3) mu e.
TEST(NodalSolids, HardenInPlaneStrainAsTheLawSays) {
  constexpr double strain = 0.2, rate = 1000, sqrt3 = 1.7320508075688772;
  auto const f = stretched(2, copper(), rate, strain / rate, 300);
  double const equivalent = 2 / sqrt3 * strain, mises = (yield + hardening * equivalent) / (1 + hardening / (3 * mu));
  for (double const q : sample(*f, "VonMisesStress", 20)) ASSERT_NEAR(q, mises, 1e-4 * mises);
}

/// Simple shear far beyond yield, all particles driven: the stress of the rate equation, integrated in small steps.
TEST(NodalSolids, FollowTheRateEquationInSimpleShear) {
  double const rate = 1e4, end = 2e-5;  // to a shear of 0.2
  auto const [expected, plastic_strain] = simple_shear(rate, end);
  ASSERT_GT(plastic_strain, 0.1);
  for (int const dimension : {2, 3}) {
    Assembly a = nodal_body(brick(dimension, 0.1), copper());
    give_velocity(a, [&](Point const& X) { return Point{rate * X[1], 0, 0}; });
    support(a, {true, true, true}, everywhere).velocity = formulas({"1e4*Y", "0", "0"});
    auto const f = make_formulation(a);
    for (int k = 0; k < 200; ++k) f->step(k * end / 200, end / 200);
    Values const sigma = sample(*f, "CauchyStress", a.particles.X.size());
    for (std::size_t k = 0; k < sigma.size(); ++k) ASSERT_NEAR(sigma[k], expected.c[k % 6], 1e-3 * yield) << k % 6;
  }
}

class NodalSolids : public ::testing::TestWithParam<int> {};

TEST_P(NodalSolids, AreHookeanAtSmallStrain) {
  auto const run = [&](MaterialParameters const& m) {
    Assembly a = nodal_body(brick(GetParam(), 0.1, {5, 5, 6}), m);
    give_velocity(a, [&](Point const& X) {
      return Point{1e-3 * std::sin(3 * X[0]), GetParam() > 1 ? 1e-3 * X[0] * X[1] : 0, 0};
    });
    a.cfl = 0.2;
    auto const f = make_formulation(a);
    advance(*f, 5e-6, 40);
    return sample(*f, "Velocity", a.particles.X.size());
  };
  Values const expected = run(material("linear_elastic", rho0, E, nu)), found = run(copper("elastic"));
  EXPECT_LT(largest_difference(found, expected), 1e-6 * largest(expected));
}

/// The error of the energy is that of Verlet's kinetic energy, of second order in the step.
TEST_P(NodalSolids, KeepTheSumOfKineticAndInternalEnergy) {
  for (std::string const law : {"elastic", "isotropic_hardening", "johnson_cook"}) {
    Assembly a = tumbling(GetParam(), law);
    a.cfl = 0.2;
    auto const error = [&](int steps) {
      auto const f = make_formulation(a);
      double const before = f->diagnose().total_energy();
      advance(*f, 4e-4 / steps, steps);
      auto const d = f->diagnose();
      double const plastic = column(d, "plastic_work");
      EXPECT_GT(d.strain_energy, 0.01 * before) << "nothing was exchanged";
      EXPECT_EQ(column(d, "internal_energy"), d.strain_energy);
      EXPECT_EQ(plastic > 0.01 * before, law != "elastic");
      EXPECT_LT(plastic, d.strain_energy);
      return std::fabs(d.total_energy() - before) / before;
    };
    double const fine = error(320);
    EXPECT_LT(fine, 2e-4) << law;
    EXPECT_LT(fine, 0.4 * error(160)) << law;
  }
}

/// Elastic copper in which heat changes the pressure.
MaterialParameters shocked_copper() {
  MaterialParameters m = copper("elastic");
  m.word[SolidLayout<NoPlasticity>::eos_word] = 2;  // mie_grueneisen
  auto const info = find_law("elastic").value();
  for (std::size_t i = 0; i < info.parameters.size(); ++i) {
    if (info.parameters[i].name == "bulk_sound_speed") m.value[i] = 3940;
    if (info.parameters[i].name == "grueneisen_gamma") m.value[i] = 2;
    if (info.parameters[i].name == "hugoniot_s1") m.value[i] = 1.489;
  }
  return m;
}

TEST(NodalShocks, HaveTheViscousPressureOfTheirRateAndHeatByItsWork) {
  constexpr double rate = 2000, step = 1e-7;  // [1/s], [s]
  auto const squeezed = [&](std::optional<double> shock, int dimension) {
    Assembly a = nodal_body(brick(dimension, 0.1), shocked_copper());
    if (shock) choose(a, "shock_viscosity", *shock);
    give_velocity(a, [&](Point const& X) { return Point{-rate * X[0], 0, 0}; });
    auto f = make_formulation(a);
    f->step(0, step);
    return f;
  };
  double const J = 1 - rate * step;
  for (int D = 1; D <= 3; ++D) {
    double h = 1;
    ParticleSet const set = brick(D, 0.1);
    for (std::size_t c = 0; c < static_cast<std::size_t>(D); ++c) h *= std::pow(set.bodies[0].spacing[c], 1.0 / D);
    double const Q = 2 * rho0 * h * h * rate * rate / J;
    auto const state = saved(*squeezed({}, D)).values.at("body0_solid_history");
    std::size_t const values = static_cast<std::size_t>(nodal::Fields::solid_values(D));
    for (std::size_t k = 0; k < state.size(); k += values)
      EXPECT_NEAR(state[k + nodal::HistoryLayout::shock_pressure], Q, 1e-6 * Q) << D;
    double const with = squeezed({}, D)->diagnose().strain_energy, without = squeezed(0.0, D)->diagnose().strain_energy;
    double volume = 0;
    for (double const V : set.volume) volume += V;
    EXPECT_NEAR(with - without, 0.5 * volume * Q * rate * step, 1e-3 * volume * Q * rate * step) << D;
  }
}

TEST_P(NodalSolids, KeepMomentaWhileTheyYield) {
  Assembly const a = tumbling(GetParam());
  auto const f = make_formulation(a);
  auto const before = f->diagnose();
  advance(*f, dt, 150);
  auto const after = f->diagnose();
  EXPECT_GT(plastic_strain(*f, a), 1e-3);
  double const scale = std::sqrt(2 * before.kinetic_energy * rho0);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(after.linear_momentum[c], before.linear_momentum[c], 1e-11 * scale);
    EXPECT_NEAR(after.angular_momentum[c], before.angular_momentum[c], 1e-11 * scale);
  }
}

TEST_P(NodalSolids, GoOnFromACheckpointBitByBit) {
  for (auto const* law : {"isotropic_hardening", "johnson_cook"}) {
    Assembly const a = tumbling(GetParam(), law);
    auto const straight = make_formulation(a), resumed = make_formulation(a);
    double const time = advance_by_itself(*straight, 0, 60);
    SavedState s = saved(*straight);
    EXPECT_GT(plastic_strain(*straight, a), 1e-4);
    resumed->load(s);
    advance_by_itself(*straight, time, 60);
    advance_by_itself(*resumed, time, 60);
    EXPECT_EQ(saved(*straight).values, saved(*resumed).values) << law;
  }
}

TEST_P(NodalSolids, GiveTheSameBitsForAnyNumberOfThreads) {
  for (double const jitter : {0.0, 0.1}) {
    auto const run = [&](int threads) {
      Threads const keep(threads);
      auto const f = make_formulation(tumbling(GetParam(), "johnson_cook", jitter));
      advance_by_itself(*f, 0, 40);
      return saved(*f).values;
    };
    auto const one = run(1);
    for (int const threads : testing::thread_counts) EXPECT_EQ(run(threads), one) << threads;
  }
}

TEST_P(NodalSolids, GiveTheSameMotionOnEveryMachine) {
  if (backends().size() < 2) GTEST_SKIP() << "this build has one machine";
  Assembly a = tumbling(GetParam(), "johnson_cook");
  auto const run = [&](std::string const& backend) {
    a.backend = backend;
    auto const f = make_formulation(a);
    advance(*f, dt, 40);
    return sample(*f, "Velocity", a.particles.X.size());
  };
  Values const reference = run(backends().back());
  for (auto const& backend : backends())
    EXPECT_LT(largest_difference(run(backend), reference), 1e-9 * largest(reference)) << backend;
}

/// What follows the step limit asks for trial steps, which must leave no trace; nor must observers.
TEST_P(NodalSolids, AreLeftAsTheyAreByTheStepLimitAndByObservers) {
  Assembly a = tumbling(GetParam());
  auto const run = [&](double cfl, bool observed) {
    a.cfl = cfl;
    auto const f = make_formulation(a);
    for (int k = 0; k < 120; ++k) {
      f->step(k * dt, dt);
      if (observed) (void)f->diagnose();
    }
    auto const values = saved(*f).values;
    return std::pair(values.at("body0_position"), values.at("body0_solid_history"));
  };
  double const measured = std::numeric_limits<double>::quiet_NaN();
  auto const plain = run(0.2, false);
  EXPECT_EQ(run(measured, false), plain);
  EXPECT_EQ(run(0.2, true), plain);
}

/// A step that crushes cells is taken again in parts, from the history that it started with.
TEST_P(NodalSolids, TakeCrushingStepsAgainFromTheHistoryAtTheirStart) {
  constexpr double step = 1e-6;
  Assembly a = nodal_body(brick(GetParam(), 0.1), copper());
  give_velocity(a, [&](Point const& X) { return Point{-0.53 / step * (X[0] + 0.1 * X[0] * X[0]), 0, 0}; });
  a.cfl = 0.2;
  auto const whole = make_formulation(a), parts = make_formulation(a);
  whole->step(0, step);
  ASSERT_EQ(column(whole->diagnose(), "repeated_steps"), 1);
  parts->step(0, 0.5 * step);
  parts->step(0.5 * step, 0.5 * step);
  ASSERT_EQ(column(parts->diagnose(), "repeated_steps"), 0);
  for (auto const* name : {"body0_position", "body0_velocity", "body0_solid_history"})
    EXPECT_EQ(saved(*whole).values.at(name), saved(*parts).values.at(name)) << name;
}

INSTANTIATE_TEST_SUITE_P(Dimensions, NodalSolids, ::testing::Values(1, 2, 3));

TEST(NodalSolidParts, KeepTheirOwnHistories) {
  for (int const dimension : {1, 2, 3}) {
    Assembly whole = tumbling(dimension, "isotropic_hardening");
    Assembly parts = whole;
    std::vector<int>& part = parts.particles.part.own();
    for (auto const& X : parts.particles.X.seen()) part.push_back(X[0] > 0.5 ? 2 : X[0] > 0.1 ? 1 : 0);
    parts.parts = {{copper(), copper()}};
    auto const moved = [](Assembly const& a) {
      auto const f = make_formulation(a);
      advance(*f, dt, 60);
      EXPECT_GT(plastic_strain(*f, a), 1e-4);
      return sample(*f, "EquivalentPlasticStrain", a.particles.X.size());
    };
    EXPECT_LT(largest_difference(moved(whole), moved(parts)), 1e-10) << dimension;
    parts.parts[0][0] = rubber();
    auto const f = make_formulation(parts);
    advance(*f, dt, 60);
    EXPECT_FALSE(f->failure().has_value());
    Values const strain = sample(*f, "EquivalentPlasticStrain", parts.particles.X.size());
    for (std::size_t i = 0; i < strain.size(); ++i)
      if (part_of(parts.particles, i) == 1) {
        EXPECT_EQ(strain[i], 0);
      }
    EXPECT_GT(largest(strain), 0);
  }
}

TEST(NodalSolidsRefused, InPlaneStressAndAsExplosives) {
  Assembly a = nodal_body(brick(2), copper());
  choose(a, "assumption", "plane_stress");
  expect_words(refusal(a), {"isotropic_hardening is a solid in rate form", "as_dimension, plane_strain"});
  Assembly b = nodal_body(brick(2), copper("elastic"));
  b.materials[0].word[0] = 4;
  auto const parameters = find_law("elastic")->parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].name == "detonation_speed") b.materials[0].value[i] = 7000;
  EXPECT_NE(refusal(b).find("eos = \"jwl\" is an explosive"), std::string::npos) << refusal(b);
}

TEST(NodalSolidsOffer, TheirFields) {
  auto const names = [](Assembly const& a) {
    std::string all;
    for (auto const& field : make_formulation(a)->observables().fields()) all += field.name + " ";
    return all;
  };
  for (std::string const name : {"EquivalentPlasticStrain", "Damage", "Temperature", "InternalEnergy"}) {
    EXPECT_NE(names(nodal_body(brick(2), copper())).find(name), std::string::npos);
    EXPECT_EQ(names(nodal_body(brick(2))).find(name), std::string::npos);
  }
  Assembly const a = nodal_body(brick(2), copper("johnson_cook"));
  for (double const t : sample(*make_formulation(a), "Temperature", a.particles.X.size())) EXPECT_EQ(t, 293);
}

}  // namespace
}  // namespace piola::testing
