// SPDX-License-Identifier: Apache-2.0
// What every solid in rate form must do, for each strength and each equation of state.
#include "materials/solid_samples.hpp"
#include "math/random.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

using testing::Random;
using testing::rotation_about;

Mat<3> full(SymMat<3> const& S) {
  Mat<3> A;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) A(i, j) = S(i, j);
  return A;
}

double distance(SymMat<3> const& a, Mat<3> const& B) { return testing::size(full(a) - B); }

SymMat<3> plus(SymMat<3> a, double s, SymMat<3> const& b) {
  for (int k = 0; k < 6; ++k) a.c[k] += s * b.c[k];
  return a;
}

template <class Case>
class SolidBattery : public ::testing::Test {
 protected:
  using Strength = typename Case::strength;
  using Eos = typename Case::eos;
  static constexpr bool yields = Strength::yields;
  static Solid<Strength, Eos> made(std::string_view damage = "none", double spall = unbounded) {
    return Solid<Strength, Eos>(sample_metal(Strength::name, Eos::name, yields ? damage : "none", spall));
  }
  Solid<Strength, Eos> const solid = made();
};

struct CaseNames {
  template <class Case>
  static std::string GetName(int) {
    return std::string(Case::strength::name) + "_" + std::string(Case::eos::name);
  }
};

TYPED_TEST_SUITE(SolidBattery, SolidCases<Strengths>::type, CaseNames);

TYPED_TEST(SolidBattery, HasNoStressAndItsOwnStiffnessAtRest) {
  auto const& s = this->solid;
  EXPECT_EQ(s.rho0, 2870);
  EXPECT_DOUBLE_EQ(s.mu, 70e9 / 2.66);
  EXPECT_EQ(s.pressure(s.rho0, 0), 0);
  double const step = 1e-6;
  double const slope = (s.pressure(s.rho0 * (1 + step), 0) - s.pressure(s.rho0 * (1 - step), 0)) / (2 * step);
  EXPECT_NEAR(slope, s.kappa, 1e-5 * s.kappa);
  EXPECT_DOUBLE_EQ(s.sound_speed(s.rho0, 0), s.p_wave_speed());
  EXPECT_DOUBLE_EQ(s.bulk_sound_speed() * s.bulk_sound_speed() * s.rho0, s.kappa);
  EXPECT_EQ(s.initial_temperature(), TestFixture::yields ? 300 : 293);
  EXPECT_EQ(s.damages, TestFixture::Strength::brittle);
}

TYPED_TEST(SolidBattery, RotatesItsStressWithARigidRotation) {
  auto const& s = this->solid;
  Vec<3> const axis{{0.2, -0.5, 1}};
  double const length = std::sqrt(dot(axis, axis)), angle = 1;
  Mat<3> const spin = (angle / length) * Mat<3>{{0, -axis[2], axis[1], axis[2], 0, -axis[0], -axis[1], axis[0], 0}};
  SymMat<3> const start = deviator_of(1e8);
  SymMat<3> S = start;
  constexpr int steps = 400;
  double const h = 1.0 / steps;
  for (int n = 0; n < steps; ++n) {  // Runge-Kutta of fourth order: error below (1/400)^4
    SymMat<3> const a = s.deviator_rate(S, spin), b = s.deviator_rate(plus(S, h / 2, a), spin);
    SymMat<3> const c = s.deviator_rate(plus(S, h / 2, b), spin), d = s.deviator_rate(plus(S, h, c), spin);
    S = plus(plus(plus(plus(S, h / 6, a), h / 3, b), h / 3, c), h / 6, d);
  }
  Mat<3> const R = rotation_about(axis, angle);
  EXPECT_LT(distance(S, R * full(start) * transpose(R)), 1e-11 * 1e8);
  EXPECT_NEAR(von_mises(S), 1e8, 1e-11 * 1e8);
}

TYPED_TEST(SolidBattery, RateIsThatOfHookesLawAndTurnsWithTheFrame) {
  auto const& s = this->solid;
  Random random(7);
  Mat<3> const L = random.matrix(10), Q = random.rotation();
  SymMat<3> const S = deviator_of(3e8);
  SymMat<3> turned;
  Mat<3> const QSQ = Q * full(S) * transpose(Q);
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) turned(i, j) = QSQ(i, j);
  SymMat<3> const rate = s.deviator_rate(S, L), turned_rate = s.deviator_rate(turned, Q * L * transpose(Q));
  double const scale = 1e2 * s.mu;
  EXPECT_LT(distance(turned_rate, Q * full(rate) * transpose(Q)), 1e-14 * scale);
  EXPECT_NEAR(rate.c[0] + rate.c[1] + rate.c[2], 0, 1e-14 * scale);
  Mat<3> const D = 0.5 * (L + transpose(L));
  Mat<3> const hooke = (2 * s.mu) * (D - (trace(D) / 3) * identity<3>());
  EXPECT_LT(distance(s.deviator_rate(SymMat<3>{}, L), hooke), 1e-14 * scale);
}

/// c^2 of the pressure is dp/drho along de = p/rho^2 drho, by central differences.
TYPED_TEST(SolidBattery, SoundSpeedIsTheStiffnessAtConstantEntropy) {
  auto const& s = this->solid;
  for (double const ratio : {0.9, 0.97, 1.05, 1.3, 1.6})
    for (double const e : {-1e4, 1e3, 5e5}) {  // Tillotson's pressure has a kink in its slope at 0
      double const rho = ratio * s.rho0, step = 1e-5 * rho, de = s.pressure(rho, e) / (rho * rho) * step;
      double const slope = (s.pressure(rho + step, e + de) - s.pressure(rho - step, e - de)) / (2 * step);
      double const c = s.sound_speed(rho, e), reference = s.kappa / s.rho0;
      ASSERT_GT(slope, 1e-4 * reference);
      EXPECT_NEAR(c * c - 4 * s.mu / (3 * rho), slope, 1e-7 * reference) << ratio << " " << e;
    }
}

TYPED_TEST(SolidBattery, StaysFiniteFarFromItsUsualStates) {
  auto const s = this->made("johnson_cook");
  for (double J = 0.2; J <= 5; J *= 1.02)
    for (double const e : {-1e6, 0.0, 1e5, 1e7, 1e9}) {
      double const rho = s.rho0 / J;
      ASSERT_TRUE(std::isfinite(s.pressure(rho, e))) << J << " " << e;
      ASSERT_TRUE(std::isfinite(s.sound_speed(rho, e))) << J << " " << e;
      ASSERT_GT(s.sound_speed(rho, e), 0);
      for (double const temperature : {1.0, 300.0, 849.999, 850.0, 1e5})
        for (double const dt : {0.0, 1e-12, 1.0}) {
          SolidHistory h;
          h.temperature = temperature;
          s.update(h, deviator_of(1e12), s.pressure(rho, e), rho, dt);
          ASSERT_TRUE(std::isfinite(von_mises(h.S)) && std::isfinite(h.temperature) && std::isfinite(h.damage));
          ASSERT_TRUE(h.damage >= 0 && h.damage <= 1 && h.plastic_work >= 0);
          s.update(h, SymMat<3>{}, 0, rho, dt);
          ASSERT_EQ(von_mises(h.S), 0);
        }
    }
}

TYPED_TEST(SolidBattery, RemembersNothingOfAnElasticStep) {
  auto const s = this->made("johnson_cook");
  SolidHistory h;
  h.plastic_strain = 0.1;
  h.temperature = 350;
  h.damage = 0.2;
  h.plastic_work = 7;
  SymMat<3> const trial = deviator_of(0.9 * 479e6);
  s.update(h, trial, 1e9, 3000, 1e-8);
  EXPECT_EQ(distance(h.S, full(trial)), 0);
  EXPECT_EQ(h.plastic_strain, 0.1);
  EXPECT_EQ(h.temperature, 350);
  EXPECT_EQ(h.damage, 0.2);
  EXPECT_EQ(h.plastic_work, 7);
}

TYPED_TEST(SolidBattery, LiesOnTheYieldSurfaceOfItsNewHistoryAfterAPlasticStep) {
  auto const& s = this->solid;
  for (double const mises : {0.5e9, 1e9, 5e9, 40e9})
    for (double const dt : {1e-10, 1e-7, 1.0}) {
      SolidHistory const before{.plastic_strain = 0.05, .temperature = 400};
      SolidHistory h = before;
      SymMat<3> const trial = deviator_of(mises), predicted = s.returned(before, trial, dt);
      s.update(h, trial, 0, 2900, dt);
      EXPECT_EQ(distance(predicted, full(h.S)), 0);
      double const strain = h.plastic_strain - before.plastic_strain;
      if (!TestFixture::yields) {
        EXPECT_EQ(strain, 0);
        continue;
      }
      SolidHistory const on_surface{.plastic_strain = h.plastic_strain, .temperature = before.temperature};
      double const yield = s.yield_stress(on_surface, strain / dt);
      // The strain is a difference, with the round-off of what it is the difference of.
      double const lost = strain > 0 ? std::log(1 + 1e-17 / strain) * yield : 0;
      EXPECT_NEAR(von_mises(h.S), std::min(yield, mises), 2e-13 * mises + lost);
      EXPECT_NEAR(von_mises(h.S), mises - 3 * s.mu * strain, 2e-13 * mises);
      EXPECT_LT(distance(h.S, (von_mises(h.S) / mises) * full(trial)), 1e-13 * mises);  // direction kept
      EXPECT_NEAR(h.plastic_work, von_mises(h.S) * strain * 2870 / 2900, 1e-12 * mises);
      EXPECT_NEAR(h.temperature - 400, 0.9 * h.plastic_work / (2870.0 * 875), 1e-10);
    }
}

TYPED_TEST(SolidBattery, BearsNoMoreTensionThanItsSpallPressure) {
  auto const s = this->made("none", 8e8);
  EXPECT_EQ(s.pressure(0.9 * s.rho0, 0), -8e8);
  EXPECT_GT(s.pressure(1.1 * s.rho0, 0), 8e8);
  EXPECT_EQ(s.sound_speed(0.9 * s.rho0, 0), this->solid.sound_speed(0.9 * s.rho0, 0));
}

}  // namespace
}  // namespace piola
