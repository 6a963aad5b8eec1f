// SPDX-License-Identifier: Apache-2.0
// Values of the laws of solids that were computed by hand from the formulas of their sources.
#include "materials/solid_samples.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

template <class Strength, class Eos>
Solid<Strength, Eos> metal(std::string_view eos, std::string_view damage = "none") {
  return Solid<Strength, Eos>(sample_metal(Strength::name, eos, damage));
}

TEST(JohnsonCookStress, HasTheValuesOfTheFormula) {
  auto const solid = metal<JohnsonCook, ElasticEos>("elastic");
  EXPECT_NEAR(solid.yield_stress({.plastic_strain = 0.1, .temperature = 400}, 1e4), 1112.885613e6, 1);
  EXPECT_NEAR(solid.yield_stress({.plastic_strain = 0.3, .temperature = 600}, 1e5), 971.234195e6, 1);
  EXPECT_EQ(solid.yield_stress({.plastic_strain = 0, .temperature = 300}, 0.5), 479e6);  // slow: no effect of rate
  EXPECT_EQ(solid.yield_stress({.plastic_strain = 1, .temperature = 900}, 1e5), 0);      // molten
}

TEST(MieGrueneisenPressure, HasTheValuesOfTheFormula) {
  auto const solid = metal<NoPlasticity, MieGrueneisen>("mie_grueneisen");
  EXPECT_NEAR(solid.pressure(2870 * 1.05, 0), 4.212348e9, 1e3);
  EXPECT_NEAR(solid.pressure(2870 * 1.1, 1e9 / 2870), 10.754281e9, 1e3);
  EXPECT_NEAR(solid.pressure(2870 * 0.98, 0), -1.629447e9, 1e3);
}

/// The root does not depend on where the search starts.
TEST(JohnsonCookReturn, IsTheSameFromAnyGuess) {
  auto const solid = metal<JohnsonCook, ElasticEos>("elastic");
  for (double const mises : {600e6, 2e9, 20e9})
    for (double const dt : {1e-10, 1e-7, 1.0}) {
      SolidHistory const before{.plastic_strain = 0.05, .temperature = 400};
      SolidHistory plain = before;
      double const flow = solid.update(plain, deviator_of(mises), 0, 2870, dt);
      EXPECT_NEAR(flow, von_mises(plain.S), 1e-12 * mises);
      for (double const guess : {1e3, 0.5 * flow, 0.999 * flow, flow, 1.01 * flow, 5 * flow}) {
        SolidHistory h = before;
        EXPECT_NEAR(solid.update(h, deviator_of(mises), 0, 2870, dt, guess), flow, 2e-13 * mises) << guess / flow;
      }
    }
}

TEST(JohnsonCookReturn, IsPredictedFromTheLastFlowStress) {
  auto const solid = metal<JohnsonCook, ElasticEos>("elastic");
  SolidHistory const h{.plastic_strain = 0.05, .temperature = 400};
  EXPECT_NEAR(von_mises(solid.predicted(h, deviator_of(1e9), 7e8, 1e-8)), 7e8, 1);
  EXPECT_NEAR(von_mises(solid.predicted(h, deviator_of(6e8), 7e8, 1e-8)), 6e8, 1);
  // None yet: the law itself.
  SymMat<3> const trial = deviator_of(1e9);
  EXPECT_EQ(von_mises(solid.predicted(h, trial, 0, 1e-8)), von_mises(solid.returned(h, trial, 1e-8)));
}

/// The fit has a pole at a compression of 1/(s1 - 1), the curve that is used has none and grows all the way.
TEST(MieGrueneisenPressure, StiffensToAnyCompression) {
  auto const solid = metal<NoPlasticity, MieGrueneisen>("mie_grueneisen");
  double last = 0;
  for (double m = 0.01; m < 8; m += 0.01) {
    double const p = solid.pressure(2870 * (1 + m), 0);
    ASSERT_GT(p, last) << m;
    ASSERT_LT(p - last, 0.05 * 20 * solid.kappa) << m;
    last = p;
  }
}

TEST(StiffenedGasPressure, HasTheValueOfTheFormula) {
  Solid<PerfectPlasticity, StiffenedGas> const solid(parameters_by_name("perfectly_plastic", "stiffened_gas", "none",
                                                                        {{"density", 2785},
                                                                         {"youngs_modulus", 74.17e9},
                                                                         {"poissons_ratio", 0.3436},
                                                                         {"yield_stress", 0.3e9},
                                                                         {"bulk_sound_speed", 5328},
                                                                         {"adiabatic_exponent", 2}}));
  EXPECT_NEAR(solid.pressure(3000, 1e6), 9.10333056e9, 1);  // 5328^2 215 + 3e9
  EXPECT_DOUBLE_EQ(solid.kappa, 2785.0 * 5328 * 5328);
}

TEST(StiffenedGasPressure, HasTheStiffnessOfYoungsModulusWithoutASoundSpeed) {
  Solid<NoPlasticity, StiffenedGas> const solid(parameters_by_name(
      "elastic", "stiffened_gas", "none",
      {{"density", 1000}, {"youngs_modulus", 3e9}, {"poissons_ratio", 0.25}, {"adiabatic_exponent", 2}}));
  EXPECT_NEAR(solid.kappa, 2e9, 1e-6);  // E / (3 (1 - 2 nu))
}

TEST(PolynomialPressure, HasTheValuesOfTheFormula) {
  auto const solid = metal<NoPlasticity, PolynomialEos>("polynomial");
  double const e = 2e9 / 2870;
  EXPECT_NEAR(solid.pressure(2870 * 1.2, e), 2.3504e10, 1);  // 79e9 0.2 + 1e11 0.04 + 5e10 0.008 + 1.652 2e9
  EXPECT_NEAR(solid.pressure(2870 * 0.9, e), -5.04e9, 1);    // -79e9 0.1 + 1.43 2e9
}

/// Compressed without heat the elastic pressure stores K/rho0 (ln r + 1/r - 1).
TEST(ElasticPressure, StoresTheEnergyOfItsIntegral) {
  auto const solid = metal<NoPlasticity, ElasticEos>("elastic");
  double const target = 1.2 * solid.rho0;
  constexpr int pieces = 200;
  double const h = (target - solid.rho0) / pieces;
  auto const slope = [&](double rho) { return solid.pressure(rho, 0) / (rho * rho); };
  double stored = 0;
  for (int n = 0; n < pieces; ++n) {  // Simpson's rule
    double const rho = solid.rho0 + n * h;
    stored += h / 6 * (slope(rho) + 4 * slope(rho + h / 2) + slope(rho + h));
  }
  EXPECT_NEAR(stored, solid.kappa / solid.rho0 * (std::log(1.2) + 1 / 1.2 - 1), 1e-9 * stored);
}

TEST(JohnsonCookFracture, HasTheValueOfTheFormula) {
  double const values[] = {0.05, 3.44, -2.12, 0.002, 0.61}, heat_values[] = {477, 1, 0, 300, 1800, 1};
  JohnsonCookDamage const damage(values, Heat(heat_values));
  // (0.05 + 3.44 exp(-0.848)) (1 + 0.002 ln 100) (1 + 0.61 / 2)
  EXPECT_NEAR(damage.fracture_strain(0.4, 100, 1050), 2.00615116, 1e-8);
  EXPECT_EQ(damage.grown(0.25, 0.5, 1), 0.75);
  EXPECT_EQ(damage.grown(0.25, 0.5, 0.1), 1);
  EXPECT_EQ(damage.grown(0.25, 0.5, -1), 1);  // a fracture strain below zero breaks at once
  EXPECT_EQ(damage.grown(0.25, 0, -1), 0.25);
}

/// With D1 alone a solid breaks when its plastic strain is D1, whatever its stress.
TEST(JohnsonCookFracture, IsCompleteAtTheFractureStrain) {
  auto material = sample_metal("perfectly_plastic", "elastic", "johnson_cook");
  LawInfo const law = *find_law("perfectly_plastic");
  for (std::size_t i = 0; i < law.parameters.size(); ++i)
    if (law.parameters[i].name == "d4") material.value[i] = 0;
  Solid<PerfectPlasticity, ElasticEos> const solid(material);
  ASSERT_TRUE(solid.damages);
  SolidHistory h{.temperature = solid.initial_temperature()};
  double const strain = 0.01, mises = 479e6 + 3 * solid.mu * strain;
  for (int n = 1; n <= 50; ++n) {
    solid.update(h, deviator_of(mises), n % 2 == 0 ? 1e9 : -1e9, solid.rho0, 1e-6);
    EXPECT_NEAR(h.plastic_strain, n * strain, 1e-10);
    EXPECT_NEAR(h.damage, std::min(1.0, n * strain / 0.45), 1e-10);
  }
  EXPECT_NEAR(h.temperature - 300, 0.9 * h.plastic_work / (2870.0 * 875), 1e-9);
  EXPECT_NEAR(h.plastic_work, 479e6 * 0.5, 1);
}

/// What spall does with a state of mean stress -p and deviator S: 0.8 GPa limit.
double damage_by_spall(int word, SymMat<3> const& S, double pressure) {
  auto material = sample_metal("perfectly_plastic", "elastic", "none", 0.8e9);
  material.word[SolidLayout<PerfectPlasticity>::spall_word] = word;
  Solid<PerfectPlasticity, ElasticEos> const solid(material);
  EXPECT_EQ(solid.damages, word > 0);
  SolidHistory h{.temperature = solid.initial_temperature()};
  solid.update(h, S, pressure, solid.rho0, 1e-9);
  return h.damage;
}

TEST(Spall, FailsByTheMeanOrTheLargestPrincipalStress) {
  constexpr int limit = 0, hydrostatic = 1, principal = 2;
  SymMat<3> const rest{}, pulled{{2e8, -1e8, -1e8, 0, 0, 0}}, sheared{{0, 0, 0, 2e8, 0, 0}};
  EXPECT_EQ(damage_by_spall(limit, pulled, -0.8e9), 0);
  EXPECT_EQ(damage_by_spall(hydrostatic, rest, -0.8e9), 1);
  EXPECT_EQ(damage_by_spall(hydrostatic, pulled, -0.79e9), 0) << "the deviator does not count";
  EXPECT_EQ(damage_by_spall(principal, pulled, -0.61e9), 1);
  EXPECT_EQ(damage_by_spall(principal, pulled, -0.59e9), 0);
  EXPECT_EQ(damage_by_spall(principal, sheared, -0.61e9), 1) << "at 45 degrees";
  EXPECT_EQ(damage_by_spall(principal, sheared, -0.59e9), 0);
  EXPECT_EQ(damage_by_spall(principal, rest, 1e9), 0);
}

/// Hardening by hand: 1 GPa trial stress, 3 mu dep + Ep dep = 1e9 - 479e6.
TEST(IsotropicHardeningReturn, HasTheValueOfTheFormula) {
  auto const solid = metal<IsotropicHardening, ElasticEos>("elastic");
  SolidHistory h;
  solid.update(h, deviator_of(1e9), 0, 2870, 1e-6);
  EXPECT_NEAR(h.plastic_strain, 521e6 / (3 * 70e9 / 2.66 + 2e9), 1e-15);
}

TEST(SolidWithoutSpecificHeat, StaysCold) {
  auto const material =
      parameters_by_name("perfectly_plastic", "elastic", "none",
                         {{"density", 1}, {"youngs_modulus", 1}, {"poissons_ratio", 0}, {"yield_stress", 1e-3}});
  Solid<PerfectPlasticity, ElasticEos> const solid(material);
  SolidHistory h{.temperature = solid.initial_temperature()};
  solid.update(h, deviator_of(1), 0, 1, 1);
  EXPECT_GT(h.plastic_work, 0);
  EXPECT_EQ(h.temperature, 293);
}

}  // namespace
}  // namespace piola
