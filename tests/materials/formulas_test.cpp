// SPDX-License-Identifier: Apache-2.0
// Values computed by hand from the formulas of the paper, with E = 5/2 and nu = 1/4: mu = lambda = 1, kappa = 5/3.
#include "piola/materials/laws.hpp"
#include "math/random.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using testing::diagonal;

constexpr double values[] = {1, 2.5, 0.25};
constexpr double round_off = 1e-13;  // values below 100, a dozen operations each

TEST(NeoHookean, HasTheValuesOfItsFormulaInAStretchByEight) {
  // F = diag(8,1,1): J = 8, J^(-2/3) = 1/4, F:F = 66, H = diag(1,8,8), p = 35/3
  NeoHookean const law(values);
  Mat<3> const F = diagonal(8, 1, 1), P = law.first_piola(F);
  EXPECT_NEAR(law.pressure(F), 35.0 / 3, round_off);
  EXPECT_NEAR(law.energy(F), 0.5 * (66.0 / 4 - 3) + 5.0 / 6 * 49, round_off);
  EXPECT_NEAR(P(0, 0), 0.25 * (8 - 66.0 / 24) + 35.0 / 3, round_off);
  EXPECT_NEAR(P(1, 1), 0.25 * (1 - 66.0 / 24 * 8) + 35.0 / 3 * 8, round_off);
  EXPECT_NEAR(P(2, 2), P(1, 1), round_off);
  EXPECT_EQ(P(0, 1), 0);
}

TEST(NeoHookean, HasTheValuesOfItsFormulaInSimpleShear) {
  // F = I + 0.6 e1 (x) e2: J = 1, F:F = 3.36, H = I - 0.6 e2 (x) e1, P = F - 1.12 H
  NeoHookean const law(values);
  Mat<3> const F{{1, 0.6, 0, 0, 1, 0, 0, 0, 1}}, P = law.first_piola(F);
  EXPECT_NEAR(law.energy(F), 0.18, round_off);
  EXPECT_NEAR(law.pressure(F), 0, round_off);
  EXPECT_NEAR(P(0, 1), 0.6, round_off);
  EXPECT_NEAR(P(1, 0), 0.672, round_off);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(P(i, i), -0.12, round_off);
}

TEST(NeoHookean, IsTheGeneralFormOfThePaperWithoutTheCofactorTerm) {
  // Eqs. (9)-(12) with xi = 0, zeta = mu/2: P = S_F + S_J H.
  NeoHookean const law(values);
  testing::Random random(1);
  for (int k = 0; k < 20; ++k) {
    Mat<3> const F = identity<3>() + random.matrix(0.4), H = cofactor(F);
    double const J = determinant(F), zeta = 0.5;
    double const S_J = -2.0 / 3 * zeta * std::pow(J, -5.0 / 3) * contract(F, F) + 5.0 / 3 * (J - 1);
    Mat<3> const expected = (2 * zeta * std::pow(J, -2.0 / 3)) * F + S_J * H;
    EXPECT_LT(testing::size(law.first_piola(F) - expected), round_off * (1 + testing::size(expected)));
  }
}

TEST(MooneyRivlin, HasTheValuesOfItsFormulaInAStretchByEight) {
  // F = diag(8,1,1): H = diag(1,8,8), H:H = 129, H x F = diag(16,65,65); xi = 1/(3 sqrt 3)
  double const all[] = {1, 2.5, 0.25, 0};
  MooneyRivlin const law(all);
  double const xi = 1 / (3 * std::sqrt(3.0)), s = 3 * xi / 64 * std::sqrt(129.0),
               S_J = -2 * xi / 512 * 129 * std::sqrt(129.0) + 35.0 / 3;
  Mat<3> const F = diagonal(8, 1, 1), P = law.first_piola(F);
  EXPECT_NEAR(law.pressure(F), 35.0 / 3, round_off);
  EXPECT_NEAR(law.energy(F), xi * 129 * std::sqrt(129.0) / 64 - 1 + 5.0 / 6 * 49, round_off);
  EXPECT_NEAR(P(0, 0), 16 * s + S_J, round_off);
  EXPECT_NEAR(P(1, 1), 65 * s + 8 * S_J, round_off);
  EXPECT_NEAR(P(2, 2), P(1, 1), round_off);
  EXPECT_EQ(P(0, 1), 0);
}

TEST(MooneyRivlin, IsNeoHookeanWhereFCarriesAllShear) {
  double const all[] = {1, 2.5, 0.25, 1};
  MooneyRivlin const law(all);
  NeoHookean const other(values);
  testing::Random random(3);
  for (int k = 0; k < 20; ++k) {
    Mat<3> const F = identity<3>() + random.matrix(0.4);
    EXPECT_LT(testing::size(law.first_piola(F) - other.first_piola(F)), round_off);
    EXPECT_NEAR(law.energy(F), other.energy(F), round_off);
    EXPECT_NEAR(law.largest_modulus(1.2, 0.9, 0.7), other.largest_modulus(1.2, 0.9, 0.7), round_off);
  }
}

TEST(MooneyRivlin, SharesStressAndEnergyLinearly) {
  double const of_F[] = {1, 2.5, 0.25, 1}, of_H[] = {1, 2.5, 0.25, 0}, both[] = {1, 2.5, 0.25, 0.3};
  testing::Random random(4);
  for (int k = 0; k < 20; ++k) {
    Mat<3> const F = identity<3>() + random.matrix(0.4);
    Mat<3> const expected = 0.3 * MooneyRivlin(of_F).first_piola(F) + 0.7 * MooneyRivlin(of_H).first_piola(F);
    EXPECT_LT(testing::size(MooneyRivlin(both).first_piola(F) - expected), round_off);
    EXPECT_NEAR(MooneyRivlin(both).energy(F), 0.3 * MooneyRivlin(of_F).energy(F) + 0.7 * MooneyRivlin(of_H).energy(F),
                round_off);
  }
}

TEST(SaintVenantKirchhoff, HasTheValuesOfItsFormulaInAStretchByTwo) {
  // E11 = 3/2: S11 = 3/2 + 3, S22 = 3/2, P = F S
  SaintVenantKirchhoff const law(values);
  Mat<3> const F = diagonal(2, 1, 1), P = law.first_piola(F);
  EXPECT_NEAR(law.energy(F), 3.375, round_off);
  EXPECT_NEAR(P(0, 0), 9, round_off);
  EXPECT_NEAR(P(1, 1), 1.5, round_off);
  EXPECT_NEAR(P(2, 2), 1.5, round_off);
  EXPECT_NEAR(law.pressure(F), 3.5, round_off);
}

TEST(SaintVenantKirchhoff, HasTheValuesOfItsFormulaInSimpleShear) {
  // E12 = 0.3, E22 = 0.18; S11 = S33 = 0.18, S12 = 0.6, S22 = 0.54
  SaintVenantKirchhoff const law(values);
  Mat<3> const F{{1, 0.6, 0, 0, 1, 0, 0, 0, 1}}, P = law.first_piola(F);
  EXPECT_NEAR(law.energy(F), 0.2286, round_off);
  EXPECT_NEAR(P(0, 0), 0.54, round_off);
  EXPECT_NEAR(P(0, 1), 0.924, round_off);
  EXPECT_NEAR(P(1, 0), 0.6, round_off);
  EXPECT_NEAR(P(1, 1), 0.54, round_off);
  EXPECT_NEAR(P(2, 2), 0.18, round_off);
}

TEST(SaintVenantKirchhoff, GivesWayUnderCompressionWhereItsDocumentationSays) {
  // Uniaxial strain: P11 = (lambda + 2 mu)/2 (l^3 - l), stationary at l = 1/sqrt 3
  SaintVenantKirchhoff const law(values);
  double const l = 1 / std::sqrt(3.0), step = 1e-4;
  auto const push = [&](double stretch) { return law.first_piola(diagonal(stretch, 1, 1))(0, 0); };
  EXPECT_GT(push(l + step), push(l));
  EXPECT_GT(push(l - step), push(l));
  EXPECT_NEAR(push(l), -1 / std::sqrt(3.0), round_off);
}

TEST(CompressibleNeoHookean, HasTheValuesOfItsFormulaInAStretchByE) {
  // ln J = 1, lambda ln J - mu = 0: P = F
  CompressibleNeoHookean const law(values);
  double const e = std::exp(1.0);
  Mat<3> const F = diagonal(e, 1, 1), P = law.first_piola(F);
  EXPECT_NEAR(law.energy(F), 0.5 * (e * e - 1) - 0.5, round_off);
  EXPECT_NEAR(P(0, 0), e, round_off);
  EXPECT_NEAR(P(1, 1), 1, round_off);
  EXPECT_NEAR(P(2, 2), 1, round_off);
  EXPECT_NEAR(law.pressure(F), (e * e + 2) / (3 * e), round_off);
}

TEST(CompressibleNeoHookean, HasTheValuesOfItsFormulaInSimpleShear) {
  // J = 1: P = F - H, H = I - 0.6 e2 (x) e1
  CompressibleNeoHookean const law(values);
  Mat<3> const F{{1, 0.6, 0, 0, 1, 0, 0, 0, 1}}, P = law.first_piola(F);
  EXPECT_NEAR(law.energy(F), 0.18, round_off);
  EXPECT_NEAR(P(0, 1), 0.6, round_off);
  EXPECT_NEAR(P(1, 0), 0.6, round_off);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(P(i, i), 0, round_off);
}

TEST(CompressibleNeoHookean, RefusesANegativePoissonsRatio) {
  Interval const allowed = CompressibleNeoHookean::parameters[2].allowed;
  EXPECT_TRUE(allowed.contains(0));
  EXPECT_FALSE(allowed.contains(-0.1));
  EXPECT_FALSE(allowed.contains(0.5));
}

TEST(LinearElastic, HasTheValuesOfItsFormulaInUniaxialStrain) {
  // P11 = (lambda + 2 mu) e, P22 = lambda e, W = 1/2 (lambda + 2 mu) e^2, p = kappa e with e = 0.1
  LinearElastic const law(values);
  Mat<3> const F = diagonal(1.1, 1, 1), P = law.first_piola(F);
  EXPECT_NEAR(P(0, 0), 0.3, round_off);
  EXPECT_NEAR(P(1, 1), 0.1, round_off);
  EXPECT_NEAR(P(2, 2), 0.1, round_off);
  EXPECT_NEAR(law.energy(F), 0.015, round_off);
  EXPECT_NEAR(law.pressure(F), 1.0 / 6, round_off);
}

TEST(LinearElastic, HasTheValuesOfItsFormulaInSimpleShear) {
  LinearElastic const law(values);
  Mat<3> const F{{1, 0.6, 0, 0, 1, 0, 0, 0, 1}}, P = law.first_piola(F);
  EXPECT_NEAR(P(0, 1), 0.6, round_off);
  EXPECT_NEAR(P(1, 0), 0.6, round_off);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(P(i, i), 0, round_off);
  EXPECT_NEAR(law.energy(F), 0.18, round_off);  // mu gamma^2 / 2
}

TEST(NeoHookean, IsLinearElasticForSmallStrain) {
  NeoHookean const large(values);
  LinearElastic const small(values);
  testing::Random random(2);
  Mat<3> const change = random.matrix(1);
  double before = 0;
  for (double const e : {1e-3, 5e-4}) {
    Mat<3> const F = identity<3>() + e * change;
    double const difference = testing::size(large.first_piola(F) - small.first_piola(F));
    if (before > 0) {
      EXPECT_NEAR(before / difference, 4, 0.05);
    }  // they differ by the square of the strain
    before = difference;
  }
}

}  // namespace
}  // namespace piola
