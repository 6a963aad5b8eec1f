// SPDX-License-Identifier: Apache-2.0
// Solids in rate form under JST-SPH.
#include "piola/formulations/jst_sph/solid_stress.hpp"
#include "formulations/copper.hpp"
#include <cstring>

namespace piola {
namespace {

using namespace testing;
using namespace testing::metals;
using jst_sph::SolidPoint;

template <class F>
void with_metal(F const& f) {
  with_solid(copper(), f);
}

/// A tumbling block that yields: speeds of some hundred metres per second on a metre.
Assembly yielding(int dimension, int n, std::string const& scheme, std::string_view law = "isotropic_hardening") {
  Assembly a = tumbling_box(dimension, n);
  a.materials.assign(1, copper(law));
  choose(a, "scheme", scheme);
  for (auto& v : a.initial_velocity)
    for (double& c : v) c *= 10;
  return a;
}
constexpr double dt = 2e-6;

SolidPoint sheared_point() {
  SolidPoint p{identity<3>(), {}, 0, 0};
  p.history.temperature = 293;
  with_metal([&](auto const& law) {
    Mat<3> F = identity<3>();
    F(0, 0) = 1.002;
    F(0, 1) = 0.0015;
    advance_solid(law, p, F, {1e-6});
  });
  return p;
}

TEST(SolidStress, TurnsWithARotationOfAnyAngleAndKeepsItsEnergy) {
  SolidPoint const before = sheared_point();
  ASSERT_GT(before.energy, 0);
  for (double const angle : {0.1, 1.0, 2.5}) {
    Mat<3> Q = identity<3>();
    Q(0, 0) = Q(1, 1) = std::cos(angle);
    Q(1, 0) = std::sin(angle);
    Q(0, 1) = -Q(1, 0);
    SolidPoint after = before;
    with_metal([&](auto const& law) { advance_solid(law, after, Q * before.F, {1e-6}); });
    Mat<3> const turned = Q * before.history.S * transpose(Q);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(after.history.S(i, j), turned(i, j), 1e-9 * yield) << angle;
    EXPECT_NEAR(after.pressure, before.pressure, 1e-9 * std::abs(before.pressure));
    EXPECT_EQ(after.history.plastic_strain, before.history.plastic_strain);
  }
}

/// P : dF of an increment in one go is that of the energy, and P follows from it.
TEST(SolidStress, BooksTheWorkOfTheMeanStress) {
  SolidPoint const before = sheared_point();
  Mat<3> const P_before = first_piola_of(before.history.S, before.pressure, before.F);
  Mat<3> F = before.F;
  F(1, 1) = 0.996;
  F(2, 1) = 0.004;
  SolidPoint after = before;
  Mat<3> P;
  with_metal([&](auto const& law) { P = advance_solid(law, after, F, {1e-6}); });
  double const work = 0.5 * contract(P_before + P, F - before.F) / rho0;
  EXPECT_NEAR(after.energy - before.energy, work, 1e-12 * std::abs(work));
  EXPECT_GT(after.history.plastic_work, before.history.plastic_work);
}

/// Simple shear far beyond yield, all particles driven: the stress of the rate equation, integrated in small steps.
TEST(Solids, FollowTheRateEquationInSimpleShear) {
  double const rate = 1e4, end = 2e-5;  // to a shear of 0.2
  auto const [expected, plastic_strain] = simple_shear(rate, end);
  ASSERT_GT(plastic_strain, 0.1);
  for (auto const* scheme : {"filtered", "robust", "paper"}) {
    Assembly a = assemble(unit_box(3, 5), copper());
    choose(a, "scheme", scheme);
    give_velocity(a, [&](Point const& X) { return Point{rate * X[1], 0, 0}; });
    support(a, {true, true, true}, everywhere).velocity = formulas({"1e4*Y", "0", "0"});
    auto const f = make_formulation(a);
    for (int k = 0; k < 200; ++k) f->step(k * end / 200, end / 200);
    ASSERT_FALSE(f->failure().has_value());
    Values const sigma = sample(*f, "CauchyStress", a.particles.X.size());
    for (std::size_t k = 0; k < sigma.size(); ++k)
      ASSERT_NEAR(sigma[k], expected.c[k % 6], 1e-3 * yield) << scheme << k % 6;
    for (double const strain : sample(*f, "EquivalentPlasticStrain", a.particles.X.size()))
      ASSERT_NEAR(strain, plastic_strain, 1e-3 * plastic_strain) << scheme;
  }
}

TEST(Solids, AreHookeanAtSmallStrain) {
  for (auto const* scheme : {"filtered", "robust"})
    for (int const dimension : {1, 2, 3}) {
      auto const run = [&](MaterialParameters const& m) {
        Assembly a = assemble(unit_box(dimension, 9), m);
        choose(a, "scheme", scheme);
        give_velocity(a, [](Point const& X) { return Point{1e-3 * std::sin(3 * X[0]), 0, 0}; });
        auto const f = make_formulation(a);
        advance(*f, 5e-6, 40);
        return sample(*f, "Velocity", a.particles.X.size());
      };
      Values const expected = run(material("linear_elastic", rho0, E, nu)), found = run(copper("elastic"));
      EXPECT_LT(largest_difference(found, expected), 1e-6 * largest(expected)) << scheme << dimension;
    }
}

/// Without stabilisation the error of the energy is that of Verlet's kinetic energy, of second order in the step.
TEST(Solids, KeepTheSumOfKineticAndInternalEnergy) {
  for (std::string const law : {"elastic", "isotropic_hardening", "johnson_cook"}) {
    Assembly a = yielding(3, 6, "filtered", law);
    choose(a, "eps4_momentum", 0.0);
    choose(a, "angular_momentum_projection", "off");
    auto const error = [&](int steps) {
      auto const f = make_formulation(a);
      double const before = f->diagnose().total_energy();
      advance(*f, 4e-4 / steps, steps);
      auto const d = f->diagnose();
      double plastic = 0, internal = 0;
      for (auto const& [name, value] : d.more) {
        if (name == "plastic_work") plastic = value;
        if (name == "internal_energy") internal = value;
      }
      EXPECT_GT(d.strain_energy, 0.01 * before) << "nothing was exchanged";
      EXPECT_EQ(internal, d.strain_energy);
      EXPECT_EQ(plastic > 0, law != "elastic");
      EXPECT_LT(plastic, internal);
      return std::fabs(d.total_energy() - before) / before;
    };
    double const fine = error(320);
    EXPECT_LT(fine, 2e-4) << law;
    EXPECT_LT(fine, 0.35 * error(160)) << law;
  }
}

TEST(Solids, GoOnFromACheckpointBitByBit) {
  for (auto const* scheme : {"filtered", "robust"})
    for (auto const* law : {"isotropic_hardening", "johnson_cook"}) {
      Assembly const a = yielding(3, 5, scheme, law);
      auto const straight = make_formulation(a), resumed = make_formulation(a);
      for (int k = 0; k < 60; ++k) straight->step(k * dt, dt);
      SavedState s = saved(*straight);
      EXPECT_GT(largest(sample(*straight, "EquivalentPlasticStrain", a.particles.X.size())), 1e-4);
      resumed->load(s);
      for (int k = 60; k < 120; ++k) {
        straight->step(k * dt, dt);
        resumed->step(k * dt, dt);
      }
      EXPECT_EQ(saved(*straight).values, saved(*resumed).values) << scheme << law;
    }
}

TEST(Solids, GiveTheSameBitsForAnyNumberOfThreads) {
  for (auto const* scheme : {"filtered", "robust"}) {
    auto const run = [&](int threads) {
      Threads const keep(threads);
      Assembly a = yielding(3, 9, scheme);
      a.cfl = 0.3;
      auto const f = make_formulation(a);
      advance(*f, dt, 20);
      return saved(*f).values;
    };
    auto const one = run(1);
    for (int const threads : testing::thread_counts) EXPECT_EQ(run(threads), one) << scheme << ", " << threads;
  }
}

TEST(Solids, GiveTheSameMotionOnEveryMachine) {
  if (backends().size() < 2) GTEST_SKIP() << "this build has one machine";
  for (auto const* scheme : {"filtered", "paper"})
    for (int const dimension : {1, 2, 3}) {
      Assembly a = yielding(dimension, dimension == 1 ? 21 : 7, scheme, "johnson_cook");
      auto const run = [&](std::string const& backend) {
        a.backend = backend;
        auto const f = make_formulation(a);
        advance(*f, dt, 40);
        EXPECT_FALSE(f->failure().has_value());
        return sample(*f, "Velocity", a.particles.X.size());
      };
      Values const reference = run(backends().back());
      for (auto const& backend : backends())
        EXPECT_LT(largest_difference(run(backend), reference), 1e-9 * largest(reference)) << backend << scheme;
    }
}

/// What follows the step limit asks for trial steps, which must leave no trace.
TEST(Solids, AreLeftAsTheyAreByTheStepLimit) {
  Assembly a = yielding(3, 5, "filtered");
  auto const run = [&](double cfl) {
    a.cfl = cfl;
    auto const f = make_formulation(a);
    advance(*f, dt, 120);
    auto values = saved(*f).values;
    values.erase("body0_step_limit");
    return values;
  };
  EXPECT_EQ(run(std::numeric_limits<double>::quiet_NaN()), run(0.3));
}

/// Pressed to a fifth of its length, a body needs a fifth of the step at most: waves cross the current distances.
TEST(Solids, TakeTheStepOfTheCurrentConfiguration) {
  for (auto const* scheme : {"filtered", "robust"}) {
    auto const limit = [&](double stretch) {
      Assembly a = assemble(unit_box(3, 7), copper("perfectly_plastic"));
      choose(a, "scheme", scheme);
      double const across = 1 / std::sqrt(stretch);
      a.initial_deformation_gradient.assign(a.particles.X.size(), {across, 0, 0, 0, across, 0, 0, 0, stretch});
      return make_formulation(a)->steady_time_step();
    };
    double const ratio = limit(0.2) / limit(1);
    EXPECT_LT(ratio, 0.25) << scheme;
    EXPECT_GT(ratio, 0.1) << scheme;
  }
}

TEST(Solids, NeedTheVariablesOfTheTotalLagrangianPair) {
  for (auto const* variables : {"pFJ", "pFHJ", "displacement"}) {
    Assembly a = assemble(unit_box(2, 5), copper());
    choose(a, "variables", variables);
    EXPECT_EQ(refusal(a),
              "formulation: variables other than \"pF\" need a hyperelastic law, and isotropic_hardening is a solid in "
              "rate form - leave variables out or take a hyperelastic law");
  }
  Assembly a = assemble(unit_box(2, 5), copper());
  choose(a, "volumetric_filter", "on");
  EXPECT_NE(refusal(a).find("isotropic_hardening is none"), std::string::npos);
}

TEST(Solids, OfferTheirFieldsAndHyperelasticBodiesDoNot) {
  auto const names = [](Assembly const& a) {
    std::string all;
    for (auto const& field : make_formulation(a)->fields()) all += field.name + " ";
    return all;
  };
  for (std::string const name : {"EquivalentPlasticStrain", "Damage", "Temperature", "InternalEnergy"}) {
    EXPECT_NE(names(assemble(unit_box(2, 5), copper())).find(name), std::string::npos);
    EXPECT_EQ(names(assemble(unit_box(2, 5))).find(name), std::string::npos);
  }
  Assembly a = assemble(unit_box(2, 5), copper("johnson_cook"));
  for (double const t : sample(*make_formulation(a), "Temperature", a.particles.X.size())) EXPECT_EQ(t, 293);
}

}  // namespace
}  // namespace piola
