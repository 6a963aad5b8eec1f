// SPDX-License-Identifier: Apache-2.0
// Strengths, explosives and scatter: values that were computed by hand from the formulas of their sources.
#include "materials/solid_samples.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

using Values = std::initializer_list<std::pair<std::string_view, double>>;

/// Copper and Armco iron of Zerilli and Armstrong 1987.
ZerilliArmstrong copper() {
  double const v[] = {65e6, 0, 890e6, 0.0028, 0.000115, 0, 1};
  return {v, Heat()};
}
ZerilliArmstrong iron() {
  double const v[] = {65e6, 1033e6, 0, 0.00698, 0.000415, 266e6, 0.289};
  return {v, Heat()};
}

TEST(ZerilliArmstrongStress, HasTheValuesOfTheFormula) {
  // 65 + 890 sqrt(0.3) exp(-0.0028 300 + 0.000115 300 ln 1000)
  EXPECT_NEAR(copper().yield_stress({.plastic_strain = 0.3, .temperature = 300}, 1e3), 332.0812e6, 1e3);
  EXPECT_EQ(copper().yield_stress({.plastic_strain = 0, .temperature = 300}, 1e3), 65e6);
  // 65 + 1033 exp(-0.00698 300 + 0.000415 300 ln 1000)
  EXPECT_NEAR(iron().yield_stress({.plastic_strain = 0, .temperature = 300}, 1e3), 365.741e6, 1e4);
  EXPECT_LT(iron().yield_stress({.temperature = 600}, 1e3), iron().yield_stress({.temperature = 300}, 1e3));
}

TEST(ZerilliArmstrongReturn, EndsOnTheYieldSurface) {
  for (auto const& law : {copper(), iron()})
    for (double const mises : {1e8, 4e8, 5e9})
      for (double const dt : {1e-10, 1e-6, 10.0})
        for (double const strain : {0.0, 0.2}) {
          FlowState const s{.plastic_strain = strain, .temperature = 350};
          double const three_mu = 3 * 48e9, x = law.increment(mises, three_mu, s, dt);
          if (x == 0) {
            EXPECT_LE(mises, law.yield_stress(s, 0));
            continue;
          }
          FlowState const after{.plastic_strain = strain + x, .temperature = 350};
          EXPECT_NEAR(mises - three_mu * x, law.yield_stress(after, x / dt), 1e-12 * mises) << mises << " " << dt;
        }
}

/// Half-hard oxygen-free copper of Steinberg 1996, at 300 K.
SteinbergGuinan half_hard_copper() {
  double const v[] = {0.12e9, 36, 0.45, 0, 0.64e9, 2.83e-11, 3.77e-4, 1790, 1.5, 2.02};
  double const heat[Heat::size] = {383, 1, 0, 300, unbounded, 1};
  return {v, Heat(heat)};
}

TEST(SteinbergGuinanStress, HasTheValuesOfTheFormulas) {
  auto const law = half_hard_copper();
  EXPECT_EQ(law.hardened(0), 0.12e9);
  EXPECT_NEAR(law.hardened(0.1), 238463695.676, 1e-2);  // 120 MPa times 4.6^0.45
  EXPECT_EQ(law.hardened(2), 0.64e9) << "1 + 36 2 to the power 0.45 is 6.9";
  EXPECT_EQ(law.stiffness(0, 1, 300), 1);
  EXPECT_NEAR(law.stiffness(10e9, 1.07, 400), 1.238988967645, 1e-12);  // 1 + 0.283/1.07^(1/3) - 0.0377
  EXPECT_EQ(law.stiffness(-50e9, 1, 300), 0);
  EXPECT_EQ(law.melting(1), 1790);
  EXPECT_NEAR(law.melting(1.2), 3159.0847, 1e-3);  // 1790 exp(0.5) 1.2^0.3733
  FlowState const s{.plastic_strain = 0.1, .temperature = 400, .pressure = 10e9, .compression = 1.07};
  EXPECT_NEAR(law.yield_stress(s, 1e5), 295453888.1266, 1e-2);
  EXPECT_EQ(law.yield_stress({.temperature = 1790}, 1e5), 0);
  EXPECT_GT(law.yield_stress({.temperature = 1790, .pressure = 20e9, .compression = 1.2}, 1e5), 0) << "not molten";
}

TEST(SteinbergGuinanReturn, EndsOnTheYieldSurface) {
  auto const law = half_hard_copper();
  for (double const mises : {1e8, 4e8, 5e9})
    for (double const strain : {0.0, 0.2, 3.0})
      for (double const pressure : {-1e9, 0.0, 2e10}) {
        FlowState const s{.plastic_strain = strain, .temperature = 350, .pressure = pressure};
        double const three_mu = 3 * 47.7e9, x = law.increment(mises, three_mu, s, 1e-8);
        if (x == 0) {
          EXPECT_LE(mises, law.yield_stress(s, 0));
          continue;
        }
        FlowState const after{.plastic_strain = strain + x, .temperature = 350, .pressure = pressure};
        EXPECT_NEAR(mises - three_mu * x, law.yield_stress(after, 0), 1e-12 * mises) << mises << " " << strain;
      }
  EXPECT_NEAR(law.increment(1e8, 3 * 47.7e9, {.temperature = 2000}, 1e-8) * 3 * 47.7e9, 1e8, 1e-4) << "molten";
}

/// Float glass of Holmquist, Johnson, Grady, Lopatin, Hertel 1995.
Solid<JohnsonHolmquist, PolynomialEos> glass(double bulking = 1) {
  return Solid<JohnsonHolmquist, PolynomialEos>(parameters_by_name("johnson_holmquist", "polynomial", "",
                                                                   {{"density", 2530},
                                                                    {"youngs_modulus", 74.56e9},
                                                                    {"poissons_ratio", 0.2263},
                                                                    {"c1", 45.4e9},
                                                                    {"c2", -138e9},
                                                                    {"c3", 290e9},
                                                                    {"hugoniot_elastic_limit", 5.95e9},
                                                                    {"pressure_at_limit", 2.92e9},
                                                                    {"tensile_strength", 0.15e9},
                                                                    {"intact_strength", 0.93},
                                                                    {"intact_exponent", 0.77},
                                                                    {"fractured_strength", 0.088},
                                                                    {"fractured_exponent", 0.35},
                                                                    {"largest_fractured_strength", 0.5},
                                                                    {"rate_coefficient", 0.003},
                                                                    {"fracture_coefficient", 0.053},
                                                                    {"fracture_exponent", 0.85},
                                                                    {"bulking", bulking}}));
}

TEST(JohnsonHolmquistStrength, HasTheValuesOfTheFormula) {
  auto const s = glass();
  // sigma_HEL = 4.545 GPa; P* = 2, T* = 0.15/2.92
  EXPECT_NEAR(s.yield_stress({}, 0, 5.84e9), 0.93 * std::pow(2 + 0.15 / 2.92, 0.77) * 4.545e9, 1);
  EXPECT_NEAR(s.yield_stress({.damage = 1}, 0, 5.84e9), 0.088 * std::pow(2, 0.35) * 4.545e9, 1);
  EXPECT_NEAR(s.yield_stress({.damage = 1}, 1e5, 5.84e9),
              (1 + 0.003 * std::log(1e5)) * 0.088 * std::pow(2, 0.35) * 4.545e9, 1);
  EXPECT_NEAR(s.yield_stress({.damage = 0.25}, 0, 5.84e9),
              0.75 * s.yield_stress({}, 0, 5.84e9) + 0.25 * s.yield_stress({.damage = 1}, 0, 5.84e9), 1);
  EXPECT_EQ(s.yield_stress({.damage = 1}, 0, -1e6), 0);  // fully damaged glass carries no tension
  EXPECT_EQ(s.yield_stress({}, 0, -0.151e9), 0);         // intact glass carries none beyond T
  EXPECT_EQ(s.yield_stress({.damage = 1}, 0, 1e15), 0.5 * 4.545e9);
}

/// In uniaxial strain the elastic axial stress at P_HEL is the Hugoniot elastic limit: the published numbers say so
/// of themselves, to the accuracy with which A (1 + T*)^N is 1.
TEST(JohnsonHolmquistStrength, YieldsAtTheHugoniotElasticLimit) {
  auto const s = glass();
  double rho = s.rho0;
  while (s.pressure(rho, 0) < 2.92e9) rho *= 1.00001;
  double const m = rho / s.rho0 - 1, axial = s.pressure(rho, 0) + 4.0 / 3 * s.mu * m / (1 + m);
  EXPECT_NEAR(axial, 5.95e9, 0.003 * 5.95e9);
  EXPECT_NEAR(s.yield_stress({}, 0, 2.92e9), 1.5 * (5.95e9 - 2.92e9), 0.04 * 4.545e9);
}

TEST(JohnsonHolmquistDamage, GrowsByTheStrainToFractureAndTakesTensionAway) {
  auto const s = glass();
  SolidHistory h{.temperature = 293};
  double const p = 2.92e9, yield = s.yield_stress(h, 0, p);
  double const fracture = 0.053 * std::pow(1 + 0.15 / 2.92, 0.85);
  s.update(h, deviator_of(yield + 3 * s.mu * 0.01), p, 1.08 * s.rho0, 1e3);  // slowly: no effect of rate
  EXPECT_NEAR(h.damage, 0.01 / fracture, 1e-9);
  EXPECT_EQ(s.pressure(h, 0.9 * s.rho0, 0), -0.15e9 * (1 - h.damage));
  s.update(h, deviator_of(1e12), p, 1.08 * s.rho0, 1e3);
  EXPECT_EQ(h.damage, 1);
  EXPECT_EQ(s.pressure({.damage = 1}, 0.9 * s.rho0, 0), 0);
}

/// The pressure of a broken point holds the elastic energy of shear that its strength lost: with
/// U = p^2 / (2 K) at constant volume of an elastic solid that is dP = -K m + sqrt((K m)^2 + 2 K dU).
TEST(JohnsonHolmquistBulking, TurnsTheLostShearEnergyIntoPressure) {
  for (double const beta : {0.0, 1.0}) {
    auto const s = glass(beta);
    SolidHistory h{.temperature = 293};
    double const p = 2.92e9, m = 0.08, before = s.yield_stress(h, 0, p);
    s.update(h, deviator_of(1e11), p, (1 + m) * s.rho0, 1e3);
    ASSERT_EQ(h.damage, 1);
    double const after = s.yield_stress(h, 0, p), lost = (before * before - after * after) / (6 * s.mu);
    double const K = 45.4e9, elastic = K * m + h.bulking;
    EXPECT_NEAR(elastic * elastic - K * m * K * m, 2 * beta * K * lost, 1e-2 * 2 * K * lost);
    EXPECT_EQ(s.pressure(h, (1 + m) * s.rho0, 0), s.pressure((1 + m) * s.rho0, 0) + h.bulking);
  }
}

struct Explosive {
  char const* name;
  double rho0, D, pressure, energy, A, B, R1, R2, omega;
};

/// Dobratz, LLNL Explosives Handbook, UCRL-52997, 1981. At the state of Chapman and Jouguet the isentrope has the slope
/// of the line of Rayleigh and lies on the Hugoniot of the explosive; a wrong digit shows.
TEST(JonesWilkinsLee, FulfilsTheConditionsOfChapmanAndJouguet) {
  for (Explosive const& x : {Explosive{"TNT", 1630, 6930, 21e9, 7e9, 371.2e9, 3.231e9, 4.15, 0.95, 0.30},
                             Explosive{"Composition B", 1717, 7980, 29.5e9, 8.5e9, 524.2e9, 7.678e9, 4.2, 1.1, 0.34},
                             Explosive{"C-4", 1601, 8193, 28e9, 9e9, 609.77e9, 12.95e9, 4.5, 1.4, 0.25},
                             Explosive{"PBX-9404", 1840, 8800, 37e9, 10.2e9, 852.4e9, 18.02e9, 4.6, 1.3, 0.38}}) {
    Solid<NoPlasticity, JwlEos> const s(parameters_by_name("elastic", "jwl", "",
                                                           {{"density", x.rho0},
                                                            {"youngs_modulus", 1},
                                                            {"poissons_ratio", 0.2},
                                                            {"jwl_a", x.A},
                                                            {"jwl_b", x.B},
                                                            {"jwl_r1", x.R1},
                                                            {"jwl_r2", x.R2},
                                                            {"jwl_omega", x.omega},
                                                            {"detonation_energy", x.energy},
                                                            {"detonation_speed", x.D}}));
    EXPECT_DOUBLE_EQ(s.initial_energy() * x.rho0, x.energy);
    EXPECT_EQ(s.front_speed(), x.D);
    double const V = 1 - x.pressure / (x.rho0 * x.D * x.D), rho = x.rho0 / V;
    double const e = (x.energy + x.pressure * (1 - V) / 2) / x.rho0;  // Hugoniot
    EXPECT_NEAR(s.pressure(rho, e), x.pressure, 0.01 * x.pressure) << x.name;
    double const c = s.sound_speed(rho, e);  // of the front, seen from the gas: c = D V
    EXPECT_NEAR(c, x.D * V, 0.01 * x.D) << x.name;
    EXPECT_EQ(s.pressure({.burnt = 0}, x.rho0, s.initial_energy()), 0);
    EXPECT_EQ(s.pressure({.burnt = 0}, 0.9 * x.rho0, s.initial_energy()), 0);
    EXPECT_DOUBLE_EQ(s.pressure({.burnt = 0.5}, x.rho0, e), 0.5 * s.pressure(x.rho0, e));
    EXPECT_NEAR(s.pressure({.burnt = 0}, rho, e), s.pressure(rho, e), 0.02 * x.pressure);  // burns when compressed
    double const half = x.rho0 / (1 - 0.5 * (1 - V));
    EXPECT_NEAR(s.pressure({.burnt = 0.2}, half, e) / s.pressure(half, e), 0.5, 0.01);
  }
}

double const off_lattice[] = {10, 0, 1};

TEST(WeibullScatter, HasHalfBelowOneAndTheSpreadOfItsModulus) {
  Scatter const scatter(off_lattice);
  int below = 0, weak = 0, n = 20000;
  for (int i = 0; i < n; ++i) {
    double const x = scatter.factor(static_cast<std::uint64_t>(i), 1e-9);
    ASSERT_TRUE(x > 0 && x < 2);
    below += x < 1 ? 1 : 0;
    weak += x < 0.8 ? 1 : 0;
  }
  EXPECT_NEAR(below, n / 2, 4 * std::sqrt(n) / 2);
  double const share = 1 - std::exp(-std::log(2.0) * std::pow(0.8, 10));  // 0.0717
  EXPECT_NEAR(weak, n * share, 4 * std::sqrt(n * share));
}

/// The weakest of eight particles of an eighth of the volume is distributed as one particle of the whole.
TEST(WeibullScatter, IsThatOfTheBodyHoweverFineItsParticles) {
  double const of_volume[] = {6, 8e-9, 3};
  Scatter const scatter(of_volume);
  int below = 0;
  constexpr int bodies = 5000;
  for (int body = 0; body < bodies; ++body) {
    double weakest = 1e9;
    for (int k = 0; k < 8; ++k)
      weakest = std::min(weakest, scatter.factor(static_cast<std::uint64_t>(8 * body + k), 1e-9));
    below += weakest < 1 ? 1 : 0;
  }
  EXPECT_NEAR(below, bodies / 2, 4 * std::sqrt(bodies) / 2);
}

TEST(WeibullScatter, DependsOnSeedAndParticleAlone) {
  double const other_seed[] = {10, 0, 2}, none[] = {unbounded, 0, 1};
  EXPECT_EQ(Scatter(off_lattice).factor(7, 1e-9), Scatter(off_lattice).factor(7, 2e-9));  // of its own volume
  EXPECT_NE(Scatter(off_lattice).factor(7, 1e-9), Scatter(other_seed).factor(7, 1e-9));
  EXPECT_NE(Scatter(off_lattice).factor(7, 1e-9), Scatter(off_lattice).factor(8, 1e-9));
  EXPECT_EQ(Scatter(none).factor(7, 1e-9), 1);
}

TEST(SolidScatter, MakesParticlesBearMoreOrLess) {
  Solid<PerfectPlasticity, ElasticEos> const s(parameters_by_name("perfectly_plastic", "elastic", "johnson_cook",
                                                                  {{"density", 2700},
                                                                   {"youngs_modulus", 70e9},
                                                                   {"poissons_ratio", 0.33},
                                                                   {"yield_stress", 3e8},
                                                                   {"d1", 0.1},
                                                                   {"spall_pressure", 1e9}}));
  SolidHistory tough{.temperature = 293, .toughness = 2}, plain{.temperature = 293};
  s.update(tough, deviator_of(3e8 + 3 * s.mu * 0.04), 0, 2700, 1);
  s.update(plain, deviator_of(3e8 + 3 * s.mu * 0.04), 0, 2700, 1);
  EXPECT_NEAR(plain.damage, 0.4, 1e-12);
  EXPECT_NEAR(tough.damage, 0.2, 1e-12);
  EXPECT_EQ(s.pressure({.toughness = 0.5}, 0.9 * 2700, 0), -5e8);
}

}  // namespace
}  // namespace piola
