// SPDX-License-Identifier: Apache-2.0
// Laws of porous solids and of concrete on blocks of points.
#include "materials/driven_point.hpp"

namespace piola::testing {
namespace {

/// Porous aluminium, 80 % of its solid density.
constexpr double solid_density = 2700, c0 = 5300, gamma0 = 2.1, s1 = 1.34, alpha0 = 1.25;
Values foam() {
  return {{"density", solid_density / alpha0},
          {"distension", alpha0},
          {"bulk_sound_speed", c0},
          {"grueneisen_gamma", gamma0},
          {"hugoniot_s1", s1},
          {"elastic_pressure", 0.1e9},
          {"compaction_pressure", 1e9},
          {"elastic_distension", 1.24},
          {"shear_modulus", 15e9},
          {"yield_stress", 0}};
}
/// Its solid with a pressure K (1 - rho0/rho) that does not depend on the energy.
Values simple_foam() { return foam() + Values{{"grueneisen_gamma", 0}, {"hugoniot_s1", 0}}; }
constexpr double solid_modulus = solid_density * c0 * c0, pore_softness = 0.01 / (0.25 * 0.1e9);
MaterialParameters p_alpha(Values const& values) { return own_material("p_alpha", values, {}); }

TEST(PAlpha, PassesTheBattery) {
  expect_battery(p_alpha(foam() + Values{{"yield_stress", 100e6}, {"spall_pressure", 500e6}}));
  expect_battery(p_alpha(foam() + Values{{"yield_stress", 100e6}, {"elastic_distension", 0}}));
  expect_battery(p_alpha(simple_foam() + Values{{"distension", 1.0}, {"elastic_distension", 0}}));
}

/// One step from rest in uniaxial strain without shear strength is a shock: E = p (1 - J)/2 per reference volume.
TEST(PAlpha, HasTheHugoniotOfACompactedSolid) {
  for (double const J : {0.76, 0.7, 0.65}) {
    DrivenPoint point(p_alpha(foam()));
    point.to(diagonal(J, 1, 1));
    double const eta = 1 - J * alpha0, hugoniot = solid_modulus * eta / std::pow(1 - s1 * eta, 2);
    double const p = hugoniot * (1 - 0.5 * gamma0 * eta) / (1 - 0.5 * gamma0 * alpha0 * (1 - J));
    ASSERT_GT(p, 1e9);
    EXPECT_NEAR(point.pressure(), p, 1e-9 * p) << J;
    EXPECT_NEAR(point.energy(), 0.5 * p * (1 - J), 1e-9 * p);
    EXPECT_EQ(point.history("Distension"), 1);
  }
}

/// Points of the Hugoniot with pores left, by the pressure: alpha p = P, and J = rho00/rho follows.
TEST(PAlpha, HasTheHugoniotOfAPorousSolid) {
  for (double const p : {0.2e9, 0.5e9, 0.8e9}) {
    double const alpha = 1 + 0.24 * std::pow((1e9 - p) / 0.9e9, 2);
    double low = 0.75, high = 1;  // of J
    for (int k = 0; k < 100; ++k) {
      double const J = 0.5 * (low + high), eta = 1 - J * alpha0 / alpha;
      double const solid =
          solid_modulus * eta * (eta > 0 ? (1 - 0.5 * gamma0 * eta) / std::pow(1 - s1 * eta, 2) : 1 / (1 - eta)) +
          gamma0 * alpha0 * 0.5 * p * (1 - J);
      (solid > alpha * p ? low : high) = J;
    }
    DrivenPoint point(p_alpha(foam()));
    point.to(diagonal(low, 1, 1));
    EXPECT_NEAR(point.pressure(), p, 1e-8 * p);
    EXPECT_NEAR(point.history("Distension"), alpha, 1e-8);
  }
}

TEST(PAlpha, CrushesAndUnloadsByItsCurves) {
  DrivenPoint point(p_alpha(simple_foam()));
  double const p = 0.5e9, alpha = 1 + 0.24 * std::pow(0.5 / 0.9, 2);
  double const J = alpha / alpha0 * (1 - alpha * p / solid_modulus), a = 1 + (alpha - 1) / (1 - pore_softness * p);
  for (int n = 1; n <= 10; ++n) {
    double const side = std::cbrt(1 + (J - 1) * n / 10);
    point.to(diagonal(side, side, side));
  }
  EXPECT_NEAR(point.pressure(), p, 1e-9 * p);
  EXPECT_NEAR(point.history("UnloadedDistension"), a, 1e-9);
  double const half = 1 + (a - 1) * (1 - pore_softness * p / 2);
  double const side = std::cbrt(half / alpha0 * (1 - half * p / 2 / solid_modulus)), free = std::cbrt(a / alpha0);
  point.to(diagonal(side, side, side));
  EXPECT_NEAR(point.pressure(), p / 2, 1e-9 * p);
  point.to(diagonal(free, free, free));
  EXPECT_NEAR(point.pressure(), 0, 1e-9 * p);
}

/// Slow compression of the solid without pores: dE = -p dJ, by Runge and Kutta's method.
TEST(PAlpha, FollowsTheIsentropeOfItsSolid) {
  double J = 1, energy = 0;
  auto const p_at = [&](double ratio, double e) {
    double const eta = 1 - ratio;
    return solid_modulus * eta * (1 - 0.5 * gamma0 * eta) / std::pow(1 - s1 * eta, 2) + gamma0 * e;
  };
  constexpr double end = 0.75;
  constexpr int steps = 2000;
  constexpr double h = (end - 1) / steps;
  for (int n = 0; n < steps; ++n, J += h) {
    double const k1 = -p_at(J, energy), k2 = -p_at(J + h / 2, energy + h / 2 * k1),
                 k3 = -p_at(J + h / 2, energy + h / 2 * k2), k4 = -p_at(J + h, energy + h * k3);
    energy += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  Values const solid = foam() + Values{{"distension", 1}, {"elastic_distension", 0}, {"density", solid_density}};
  DrivenPoint point(p_alpha(solid));
  for (int n = 1; n <= 4000; ++n) point.to(diagonal(1, 1 + (end - 1) * n / 4000, 1));
  EXPECT_NEAR(point.energy(), energy, 1e-6 * energy);
  EXPECT_NEAR(point.pressure(), p_at(J, energy), 1e-6 * p_at(J, energy));
}

TEST(PAlpha, HasItsShearStrengthAndTensionLimits) {
  DrivenPoint point(p_alpha(foam() + Values{{"yield_stress", 50e6}, {"spall_pressure", 20e6}}));
  double const side = std::exp(-0.01);
  for (int n = 1; n <= 100; ++n) point.to(diagonal(1, std::exp(-1e-4 * n), 1));
  EXPECT_NEAR(point.mises(), 50e6, 1);
  EXPECT_NEAR(point.history("EquivalentPlasticStrain"), 2.0 / 3 * 0.01 - 50e6 / (3 * 15e9), 1e-9);
  point.to(diagonal(1.02, side, 1.02));
  EXPECT_NEAR(point.pressure(), -20e6, 1e-6);
}

/// At rest c_e^2 = c0^2/(1 + K beta/alpha0^2), beta = (alpha0 - alpha_e)/p_e (Herrmann's d alpha/dp).
TEST(PAlpha, HasTheSoundSpeedOfElasticPores) {
  BlockLaw const law(p_alpha(foam()));
  double const square = c0 * c0 / (1 + solid_modulus * 0.01 / 0.1e9 / (alpha0 * alpha0));
  EXPECT_NEAR(law.kappa / law.rho0, square, 1e-5 * square);
  DrivenPoint point(p_alpha(foam()));
  point.to(diagonal(1, 1, 1));
  EXPECT_NEAR(point.sound_speed(), law.p_wave_speed(), 1e-5 * law.p_wave_speed());
}

TEST(PAlpha, RefusesParametersThatDoNotGoTogether) {
  auto const problem = [](Values const& more) { return problem_of_block_law(p_alpha(foam() + more)); };
  EXPECT_EQ(problem({{"compaction_pressure", 0.1e9}}),
            "compaction_pressure 1e+08 Pa must be above elastic_pressure, 1e+08 Pa");
  EXPECT_NE(problem({{"elastic_distension", 1.3}}).find("between 1 and distension"), std::string::npos);
  EXPECT_NE(problem({{"elastic_distension", 1.2}}).find("pores close by elasticity"), std::string::npos);
}

/// Concrete of 48 MPa of the paper of 1993.
Values concrete() {
  return {{"density", 2440},
          {"shear_modulus", 14.86e9},
          {"compressive_strength", 48e6},
          {"tensile_strength", 4e6},
          {"cohesive_strength", 0.79},
          {"pressure_hardening", 1.6},
          {"pressure_exponent", 0.61},
          {"rate_coefficient", 0.007},
          {"largest_strength", 7},
          {"fracture_coefficient", 0.04},
          {"crush_pressure", 16e6},
          {"crush_compression", 0.001},
          {"lock_pressure", 0.8e9},
          {"lock_compression", 0.1},
          {"k1", 85e9},
          {"k2", -171e9},
          {"k3", 208e9}};
}
MaterialParameters hjc(Values const& values) { return own_material("holmquist_johnson_cook", values, {}); }
Mat<3> compressed(double m) {
  double const side = 1 / std::cbrt(1 + m);
  return diagonal(side, side, side);
}
/// m at the pressure of locking: K1 x + K2 x^2 + K3 x^3 = 0.8 GPa has x = 0.00959789.
double lock_end() {
  double x = 0.0096;
  for (int k = 0; k < 20; ++k) x = 0.8e9 / (85e9 - 171e9 * x + 208e9 * x * x);
  return 0.1 + 1.1 * x;
}

TEST(HolmquistJohnsonCook, PassesTheBattery) {
  expect_battery(hjc(concrete()));
  expect_battery(hjc(concrete() + Values{{"rate_coefficient", 0}, {"k2", 0}, {"k3", 0}}));
}

TEST(HolmquistJohnsonCook, CrushesLocksAndUnloads) {
  DrivenPoint point(hjc(concrete()));
  point.to(compressed(0.0005));
  EXPECT_NEAR(point.pressure(), 8e6, 1e-3);
  point.to(compressed(0.001));
  EXPECT_NEAR(point.pressure(), 16e6, 1e-3);
  double const slope = (0.8e9 - 16e6) / (lock_end() - 0.001), top = 16e6 + slope * 0.049;
  point.to(compressed(0.05));
  EXPECT_NEAR(point.pressure(), top, 1e-9 * top);
  double const part = 0.049 / (lock_end() - 0.001), unloading = (1 - part) * 16e9 + part * 85e9;
  point.to(compressed(0.045));
  EXPECT_NEAR(point.pressure(), top - unloading * 0.005, 1e-9 * top);
  point.to(compressed(0.15));
  double const x = 0.05 / 1.1, locked = x * (85e9 + x * (-171e9 + x * 208e9));
  EXPECT_NEAR(locked, 3.5299e9, 1e5);
  EXPECT_NEAR(point.pressure(), locked, 1e-9 * locked);
  point.to(compressed(0.1));
  EXPECT_NEAR(point.pressure(), 0, 1);
}

/// Damage by crushing alone: the integral of d(plastic part of m) / (D1 (P* + T*)).
TEST(HolmquistJohnsonCook, IsDamagedByCrushing) {
  double const slope = (0.8e9 - 16e6) / (lock_end() - 0.001), end = 0.01;
  auto const pressure = [&](double m) { return 16e6 + slope * (m - 0.001); };
  auto const plastic = [&](double m) {
    double const part = (m - 0.001) / (lock_end() - 0.001);
    return m - pressure(m) / ((1 - part) * 16e9 + part * 85e9);
  };
  double exact = 0;
  constexpr int steps = 20000;
  for (int n = 0; n < steps; ++n) {
    double const a = 0.001 + (end - 0.001) * n / steps, b = 0.001 + (end - 0.001) * (n + 1) / steps;
    exact += (plastic(b) - plastic(a)) / std::max(0.04 * (pressure(0.5 * (a + b)) + 4e6) / 48e6, 0.01);
  }
  auto const driven = [&](int count) {
    DrivenPoint point(hjc(concrete()));
    for (int n = 0; n <= count; ++n) point.to(compressed(0.001 + (end - 0.001) * n / count));
    return point.history("Damage");
  };
  EXPECT_GT(exact, 0.05);
  EXPECT_NEAR(2 * driven(20000) - driven(10000), exact, 1e-6);
}

/// Shear at constant volume: damage grows in proportion to plastic strain, and the strength falls in proportion to it.
TEST(HolmquistJohnsonCook, SoftensInShear) {
  double const m = 0.003, strain = 0.02, rate = 100;
  auto const driven = [&](int count) {
    DrivenPoint point(hjc(concrete()));
    point.to(compressed(m));
    double const start = point.history("Damage"), side = 1 / std::cbrt(1 + m);
    for (int n = 1; n <= count; ++n) {
      double const e = strain * n / count;
      point.to(diagonal(side * std::exp(e / 2), side * std::exp(e / 2), side * std::exp(-e)), strain / count / rate);
    }
    return std::array{point.mises(), point.history("Damage"), point.pressure(), start};
  };
  auto const coarse = driven(20000), fine = driven(40000);
  double const P = fine[2] / 48e6, limit = 0.04 * (P + 4.0 / 48), factor = 1 + 0.007 * std::log(rate), G = 14.86e9;
  ASSERT_GT(limit, 0.01);
  double const intact = 48e6 * factor * (0.79 * (1 - fine[3]) + 1.6 * std::pow(P, 0.61));
  double const fall = 48e6 * factor * 0.79 / limit;  // of the strength per plastic strain
  double const plastic = (strain - intact / (3 * G)) / (1 - fall / (3 * G));
  ASSERT_LT(fine[3] + plastic / limit, 1);
  EXPECT_NEAR(2 * fine[0] - coarse[0], intact - fall * plastic, 1e-5 * intact);
  EXPECT_NEAR(2 * fine[1] - coarse[1], fine[3] + plastic / limit, 1e-5);
}

TEST(HolmquistJohnsonCook, HasLimitsOfTensionAndStrength) {
  DrivenPoint pulled(hjc(concrete()));
  pulled.to(compressed(-0.0005));
  EXPECT_NEAR(pulled.pressure(), -4e6, 1e-3);
  DrivenPoint pressed(hjc(concrete()));
  pressed.to(compressed(0.15));
  for (int n = 1; n <= 100; ++n) pressed.to(sheared(1e-3 * n) * compressed(0.15), 1e-6);
  EXPECT_NEAR(pressed.mises(), 7 * 48e6, 1);
}

TEST(HolmquistJohnsonCook, RefusesParametersThatDoNotGoTogether) {
  auto const problem = [](Values const& more) { return problem_of_block_law(hjc(concrete() + more)); };
  EXPECT_EQ(problem({{"lock_pressure", 16e6}}), "lock_pressure 1.6e+07 Pa must be above crush_pressure, 1.6e+07 Pa");
  EXPECT_NE(problem({{"k3", 0}}).find("k2 above"), std::string::npos);
  EXPECT_NE(problem({{"crush_compression", 0.2}}).find("crush_compression"), std::string::npos);
  EXPECT_NE(problem({{"lock_compression", 0.01}}).find("would give energy"), std::string::npos);
}

}  // namespace
}  // namespace piola::testing
