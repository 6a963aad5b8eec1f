// SPDX-License-Identifier: Apache-2.0
// Laws of soil and of composites on blocks of points.
#include "materials/driven_point.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace piola::testing {
namespace {

constexpr double degrees = std::numbers::pi / 180;

constexpr double E = 200e6, nu = 0.25, kappa = E / (3 * (1 - 2 * nu)), mu = E / (2 * (1 + nu));

Values elastic() { return {{"density", 1800}, {"youngs_modulus", E}, {"poissons_ratio", nu}}; }
Values soil(double dilation = 0) {
  return elastic() + Values{{"friction_angle", 30 * degrees}, {"cohesion", 20e3}, {"dilation_angle", dilation}};
}
Values capped(double dilation = 0) {
  return soil(dilation) + Values{{"cap_ratio", 2}, {"cap_start", 200e3}, {"cap_strain", 0.2}, {"cap_rate", 5e-7}};
}
MaterialParameters drucker_prager(Values const& values, std::vector<int> const& words = {0, 0}) {
  return own_material("drucker_prager", values, words);
}

TEST(DruckerPrager, PassesTheBattery) {
  expect_battery(drucker_prager(soil()));
  expect_battery(drucker_prager(soil(20 * degrees) + Values{{"tension_cutoff", 5e3}}, {1, 0}));
  expect_battery(drucker_prager(capped(10 * degrees), {0, 1}));
  expect_battery(drucker_prager(elastic() + Values{{"alpha", 0.2}, {"k", 1e5}, {"alpha_dilation", 0.1}}, {2, 0}));
  expect_battery(drucker_prager(soil() + Values{{"cohesion", 0}}));
}

TEST(DruckerPrager, HasItsElasticModuliWithoutCohesion) {
  BlockLaw const law(drucker_prager(soil() + Values{{"cohesion", 0}}));
  EXPECT_NEAR(law.kappa, kappa, 1e-5 * kappa);
  EXPECT_NEAR(law.mu, mu, 1e-5 * mu);
}

/// Triaxial compression under a constant lateral stress fails at Mohr-Coulomb's axial stress.
TEST(DruckerPrager, FailsInTriaxialCompressionAsMohrCoulomb) {
  for (double const dilation : {0.0, 15 * degrees}) {
    DrivenPoint point(drucker_prager(soil(dilation)));
    double const lateral = -100e3, Nphi = 3;  // tan^2(45 + 30/2 degrees)
    double side = point.side_of_stress(lateral, 1 - 1e-4);
    for (int k = 1; k <= 400; ++k) {
      side = point.side_of_stress(lateral, 1 - 5e-5 * k);
      point.to(diagonal(side, side, 1 - 5e-5 * k));
    }
    EXPECT_NEAR(point.stress(0), lateral, 1);
    EXPECT_NEAR(point.stress(2), lateral * Nphi - 2 * 20e3 * std::sqrt(Nphi), 1e-5 * 369e3);
    double const s = std::sin(dilation);
    EXPECT_NEAR(point.history("VolumetricPlasticStrain"), 6 * s / (3 - s) * point.history("EquivalentPlasticStrain"),
                1e-9);
    EXPECT_GT(point.history("EquivalentPlasticStrain"), 0.01);
  }
}

/// In plane strain the cone of that word fails as Mohr-Coulomb's, whatever the dilation, once elastic strains rest.
TEST(DruckerPrager, FailsInPlaneStrainAsMohrCoulomb) {
  for (double const dilation : {0.0, 10 * degrees, 30 * degrees}) {
    DrivenPoint point(drucker_prager(soil(dilation), {1, 0}));
    double const lateral = -100e3, Nphi = 3;
    for (int k = 1; k <= 600; ++k) {
      double const axial = 1 - 1e-4 * k;
      point.to(diagonal(point.side_of_stress(lateral, axial, 1), 1, axial));
    }
    EXPECT_NEAR(point.stress(2), lateral * Nphi - 2 * 20e3 * std::sqrt(Nphi), 1e-4 * 369e3) << dilation;
  }
}

/// In uniaxial strain the stress follows two straight lines of the logarithmic strain.
TEST(DruckerPrager, YieldsInUniaxialStrainAlongALine) {
  double const alpha = 0.1, k = 1e5, potential = 0.05;
  DrivenPoint point(
      drucker_prager(elastic() + Values{{"alpha", alpha}, {"k", k}, {"alpha_dilation", potential}}, {2, 0}));
  double const A = std::sqrt(3.0) * k, B = 3 * std::sqrt(3.0) * alpha, D = 3 * std::sqrt(3.0) * potential;
  for (int n = 1; n <= 2000; ++n) point.to(diagonal(1, 1, std::exp(-1e-5 * n)));
  double const strain = 0.02, yield = A / (2 * mu - B * kappa), more = strain - yield;
  ASSERT_GT(more, 0.01);
  double const x = (2 * mu - B * kappa) / (3 * mu + kappa * B * D) * more;
  EXPECT_NEAR(point.pressure(), kappa * (strain + D * x), 1e-6 * kappa * strain);
  EXPECT_NEAR(point.mises(), 2 * mu * strain - 3 * mu * x, 1e-6 * 2 * mu * strain);
}

TEST(DruckerPrager, StopsTensionAtTheApexOrTheCutOff) {
  double const k_over_3_alpha = 20e3 / std::tan(30 * degrees);  // where Mohr-Coulomb's pyramid ends, too
  DrivenPoint apex(drucker_prager(soil()));
  apex.to(diagonal(1.001, 1.001, 1.001));
  EXPECT_NEAR(apex.pressure(), -k_over_3_alpha, 1e-9 * k_over_3_alpha);
  EXPECT_NEAR(apex.history("VolumetricPlasticStrain"), 3 * 2 * 0.001 / 2.001 - k_over_3_alpha / kappa, 1e-9);
  DrivenPoint sheared(drucker_prager(soil()));
  sheared.to(diagonal(1.02, 1.001, 1.001));
  EXPECT_NEAR(sheared.pressure(), -k_over_3_alpha, 1e-9 * k_over_3_alpha);
  EXPECT_NEAR(sheared.mises(), 0, 1e-6);
  DrivenPoint cut(drucker_prager(soil() + Values{{"tension_cutoff", 5e3}}));
  cut.to(diagonal(1.02, 1.001, 1.001));
  EXPECT_NEAR(cut.pressure(), -5e3, 1e-5);
  double const s = std::sin(30 * degrees), scale = 6 / (3 - s);
  EXPECT_NEAR(cut.mises(), scale * (20e3 * std::cos(30 * degrees) - 5e3 * s), 1e-5);
}

TEST(DruckerPrager, CompactsAlongTheCap) {
  DrivenPoint point(drucker_prager(capped(), {0, 1}));
  for (int n = 1; n <= 1000; ++n) {
    double const side = std::exp(-4e-5 * n);
    point.to(diagonal(side, side, side));
  }
  double const p = point.pressure(), compaction = 0.2 * (1 - std::exp(-5e-7 * (p - 200e3)));
  EXPECT_GT(p, 1e6);
  EXPECT_NEAR(point.history("CapCompaction"), compaction, 1e-9);
  EXPECT_NEAR(p / kappa + compaction, 3 * 0.04, 1e-8);
  EXPECT_NEAR(point.history("VolumetricPlasticStrain"), -compaction, 1e-9);
}

/// The differential equation of the cap in uniaxial strain, by the consistency condition.
struct CapEquation {
  double A, B, p = 0, q = 0, e = 0;

  double square(double pressure, double mises, double compaction) const {
    double const X = 200e3 - std::log(1 - compaction / 0.2) / 5e-7, L = (X - 2 * A) / (1 + 2 * B), F = A + B * L;
    return std::pow((pressure - L) / (X - L), 2) + std::pow(mises / F, 2);
  }
  std::array<double, 3> rate(std::array<double, 3> const& y) const {
    double const h = 1.0, he = 1e-7;
    auto const difference = [&](double dp, double dq, double de) {
      return 0.5 * (square(y[0] + dp, y[1] + dq, y[2] + de) - square(y[0] - dp, y[1] - dq, y[2] - de));
    };
    double const fp = difference(h, 0, 0) / h, fq = difference(0, h, 0) / h, fe = difference(0, 0, he) / he;
    double const l = (fp * kappa + fq * 2 * mu) / (fp * fp * kappa + fq * fq * 3 * mu - fe * fp);
    return {kappa * (1 - l * fp), 2 * mu - 3 * mu * l * fq, l * fp};
  }
  void advance(double strain) {
    std::array<double, 3> const y{p, q, e}, k1 = rate(y);
    auto const at = [&](std::array<double, 3> const& k, double step) {
      return std::array{y[0] + step * k[0], y[1] + step * k[1], y[2] + step * k[2]};
    };
    auto const k2 = rate(at(k1, strain / 2)), k3 = rate(at(k2, strain / 2)), k4 = rate(at(k3, strain));
    auto const mean = [&](std::size_t i) { return strain / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]); };
    p += mean(0), q += mean(1), e += mean(2);
  }
};

TEST(DruckerPrager, FollowsTheEquationOfTheCapInUniaxialStrain) {
  double const s = 0.5, A = 6 * 20e3 * std::cos(30 * degrees) / (3 - s), B = 6 * s / (3 - s), strain = 0.1;
  CapEquation exact{A, B};
  double low = 0, high = 0.01;  // the strain at which the cap is reached
  for (int k = 0; k < 100; ++k) {
    double const middle = 0.5 * (low + high);
    (exact.square(kappa * middle, 2 * mu * middle, 0) > 1 ? high : low) = middle;
  }
  exact.p = kappa * low, exact.q = 2 * mu * low;
  for (int n = 0; n < 20000; ++n) exact.advance((strain - low) / 20000);
  auto const driven = [&](int steps) {
    DrivenPoint point(drucker_prager(capped(), {0, 1}));
    for (int n = 1; n <= steps; ++n) point.to(diagonal(1, 1, std::exp(-strain * n / steps)));
    return std::array{point.pressure(), point.mises(), point.history("CapCompaction")};
  };
  auto const coarse = driven(10000), fine = driven(20000);  // first order in the step: extrapolated
  EXPECT_GT(exact.e, 0.05);
  EXPECT_NEAR(2 * fine[0] - coarse[0], exact.p, 1e-6 * exact.p);
  EXPECT_NEAR(2 * fine[1] - coarse[1], exact.q, 1e-6 * exact.q);
  EXPECT_NEAR(2 * fine[2] - coarse[2], exact.e, 1e-6 * exact.e);
}

/// Dilation under confinement brings the stress to the corner of cone and cap, where it stays.
TEST(DruckerPrager, StaysAtTheCornerOfConeAndCap) {
  DrivenPoint point(drucker_prager(capped(20 * degrees), {0, 1}));
  double const s = 0.5, A = 6 * 20e3 * std::cos(30 * degrees) / (3 - s), B = 6 * s / (3 - s);
  double const L = (200e3 - 2 * A) / (1 + 2 * B);
  for (int n = 1; n <= 500; ++n) point.to(sheared(1e-4 * n));
  EXPECT_NEAR(point.pressure(), L, 1e-6 * L);
  EXPECT_NEAR(point.mises(), A + B * L, 1e-6 * A);
  EXPECT_LT(point.history("CapCompaction"), 1e-12);
}

TEST(DruckerPrager, RefusesParametersThatDoNotGoTogether) {
  auto const problem = [](Values const& values, std::vector<int> const& words) {
    return problem_of_block_law(drucker_prager(values, words));
  };
  EXPECT_EQ(problem(soil(31 * degrees), {0, 0}),
            "dilation_angle 0.5411 rad is above friction_angle 0.5236 rad, and plastic flow would give energy (0 to "
            "friction_angle is allowed)");
  EXPECT_NE(problem(elastic() + Values{{"alpha", 0.1}, {"k", 1}, {"alpha_dilation", 0.2}}, {2, 0}).find("above alpha"),
            std::string::npos);
  EXPECT_NE(problem(elastic() + Values{{"alpha", 0}, {"k", 0}}, {2, 0}).find("no strength"), std::string::npos);
  EXPECT_NE(problem(capped() + Values{{"cap_start", 1e3}}, {0, 1}).find("cap_start"), std::string::npos);
}

/// Carbon fibres in epoxy: T300/5208 with transverse isotropy.
Values lamina() {
  return {{"density", 1600},
          {"youngs_modulus_1", 181e9},
          {"youngs_modulus_2", 10.3e9},
          {"youngs_modulus_3", 10.3e9},
          {"poissons_ratio_12", 0.28},
          {"poissons_ratio_13", 0.28},
          {"poissons_ratio_23", 0.45},
          {"shear_modulus_12", 7.17e9},
          {"shear_modulus_13", 7.17e9},
          {"shear_modulus_23", 3.55e9}};
}
Values strengths() {
  return {{"tensile_strength_1", 1500e6},     {"tensile_strength_2", 40e6},      {"tensile_strength_3", 40e6},
          {"compressive_strength_1", 1500e6}, {"compressive_strength_2", 246e6}, {"compressive_strength_3", 246e6},
          {"shear_strength_12", 68e6},        {"shear_strength_13", 68e6},       {"shear_strength_23", 50e6}};
}
Values along(double x1, double y1, double z1, double x2, double y2, double z2) {
  return {{"axis_1_x", x1}, {"axis_1_y", y1}, {"axis_1_z", z1}, {"axis_2_x", x2}, {"axis_2_y", y2}, {"axis_2_z", z2}};
}
MaterialParameters orthotropic(Values const& values, int failure = 0) {
  return own_material("orthotropic", values, {failure});
}

TEST(Orthotropic, PassesTheBattery) {
  expect_battery(orthotropic(lamina()));
  expect_battery(orthotropic(lamina() + along(1, 2, 3, -1, 1, 0)));
  expect_battery(orthotropic(lamina() + strengths(), 1));
  expect_battery(orthotropic(lamina() + strengths() + Values{{"residual_stiffness", 0.1}}, 1));
}

/// Stiffness by hand: C11 = E1 (1 - nu23 nu32)/D, C12 = E1 (nu21 + nu31 nu23)/D, ..., with nu_ji = nu_ij Ej/Ei and
/// D = 1 - nu12 nu21 - nu23 nu32 - nu13 nu31 - 2 nu21 nu32 nu13.
TEST(Orthotropic, HasTheStiffnessOfItsConstants) {
  double const E1 = 140e9, E2 = 10e9, E3 = 8e9, n12 = 0.3, n13 = 0.25, n23 = 0.4, G12 = 5e9, G13 = 4e9, G23 = 3e9;
  double const n21 = n12 * E2 / E1, n31 = n13 * E3 / E1, n32 = n23 * E3 / E2;
  double const D = 1 - n12 * n21 - n23 * n32 - n13 * n31 - 2 * n21 * n32 * n13;
  double const C[6][6]{{E1 * (1 - n23 * n32) / D, E1 * (n21 + n31 * n23) / D, E1 * (n31 + n21 * n32) / D, 0, 0, 0},
                       {E1 * (n21 + n31 * n23) / D, E2 * (1 - n13 * n31) / D, E2 * (n32 + n12 * n31) / D, 0, 0, 0},
                       {E1 * (n31 + n21 * n32) / D, E2 * (n32 + n12 * n31) / D, E3 * (1 - n12 * n21) / D, 0, 0, 0},
                       {0, 0, 0, 2 * G12, 0, 0},
                       {0, 0, 0, 0, 2 * G23, 0},
                       {0, 0, 0, 0, 0, 2 * G13}};
  BlockLaw const law(orthotropic({{"density", 1600},
                                  {"youngs_modulus_1", E1},
                                  {"youngs_modulus_2", E2},
                                  {"youngs_modulus_3", E3},
                                  {"poissons_ratio_12", n12},
                                  {"poissons_ratio_13", n13},
                                  {"poissons_ratio_23", n23},
                                  {"shear_modulus_12", G12},
                                  {"shear_modulus_13", G13},
                                  {"shear_modulus_23", G23}}));
  constexpr double small = 1e-5;
  for (std::size_t j = 0; j < 6; ++j) {
    std::array<double, 6> e{};
    e[j] = small;
    auto const above = law.stress_at(e);
    e[j] = -small;
    auto const below = law.stress_at(e);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR((above[i] - below[i]) / (2 * small), C[i][j], 1e-6 * E1) << i << j;
  }
}

/// Fibres turned by a right angle about z: the stresses along x and y change places. A frame of any directions gives
/// the stress of the deformation seen from it, at large strain, too.
TEST(Orthotropic, TurnsWithItsAxes) {
  DrivenPoint turned(orthotropic(lamina() + along(0, 2, 0, -1, 0, 0))), straight(orthotropic(lamina()));
  turned.to(diagonal(1.02, 1.01, 0.98));
  straight.to(diagonal(1.01, 1.02, 0.98));
  for (int const c : {0, 1, 2}) EXPECT_NEAR(turned.stress(c), straight.stress(c == 2 ? 2 : 1 - c), 1e-3);
  // a1 = (1, 2, 2)/3, a2 = (2, 1, -2)/3, a3 = (-2, 2, -1)/3, the second vector with a part of a1
  Mat<3> const Q{{1.0 / 3, 2.0 / 3, 2.0 / 3, 2.0 / 3, 1.0 / 3, -2.0 / 3, -2.0 / 3, 2.0 / 3, -1.0 / 3}};
  DrivenPoint oblique(orthotropic(lamina() + along(1, 2, 2, 3, 3, 0))), seen(orthotropic(lamina()));
  Mat<3> F = diagonal(1.1, 0.9, 1.05);
  F(0, 1) = 0.2;
  F(2, 1) = -0.1;
  oblique.to(F);
  seen.to(Q * F * transpose(Q));
  Mat<3> const difference = Q * oblique.first_piola() * transpose(Q) - seen.first_piola();
  EXPECT_LT(std::sqrt(contract(difference, difference)), 1e-9 * 181e9);
}

/// Uniaxial stretch along a fibre with free sides: S11 = E1 (l^2 - 1)/2, sides by Poisson's ratios of Green strains.
TEST(Orthotropic, PullsFibresByGreenStrain) {
  double const l = 1.05, strain = 0.5 * (l * l - 1), side = std::sqrt(1 - 2 * 0.28 * strain);
  DrivenPoint point(orthotropic(lamina()));
  point.to(diagonal(l, side, side));
  EXPECT_NEAR(point.first_piola()(0, 0), l * 181e9 * strain, 1e-3);
  EXPECT_NEAR(point.stress(1), 0, 1);
}

/// F11 = 1/(1500 MPa)^2, F1 = 0, F22 = 1/(40 * 246 MPa^2), F2 = 1/40 - 1/246 per MPa (Tsai, Hahn 1980).
TEST(Orthotropic, HasTheFailureIndexOfTsaiAndWu) {
  auto const index = [](double s11, double s22, double s12) {
    // Strains of small stresses, one millionth of these, whose index is that of strengths one millionth as large.
    Values small = strengths();
    for (auto& [name, value] : small) value *= 1e-6;
    DrivenPoint point(orthotropic(lamina() + small, 1));
    double const a = 1e-6 * (s11 - 0.28 * s22) / 181e9, b = 1e-6 * (s22 / 10.3e9 - 0.28 * s11 / 181e9);
    Mat<3> F = diagonal(1 + a, 1 + b, 1 + 1e-6 * (-0.28 * s11 / 181e9 - 0.45 * s22 / 10.3e9));
    F(0, 1) = F(1, 0) = 1e-6 * s12 / (2 * 7.17e9);
    point.to(F);
    return point.history("FailureIndex");
  };
  EXPECT_NEAR(index(1500e6, 0, 0), 1, 1e-6);
  EXPECT_NEAR(index(-1500e6, 0, 0), 1, 1e-6);
  EXPECT_NEAR(index(0, 40e6, 0), 1, 1e-6);
  EXPECT_NEAR(index(0, -246e6, 0), 1, 1e-6);
  EXPECT_NEAR(index(0, 0, 68e6), 1, 1e-6);
  double const root = std::sqrt(40.0 * 246.0);  // MPa
  EXPECT_NEAR(index(750e6, 20e6, 34e6),
              0.25 + 400 / (root * root) + 20 * (1 / 40.0 - 1 / 246.0) - 0.5 * 20 / root + 0.25, 1e-6);
}

TEST(Orthotropic, LosesAllStiffnessesAlikeAtFailure) {
  Values const weakening = strengths() + Values{{"residual_stiffness", 0.2}};
  DrivenPoint whole(orthotropic(lamina())), weak(orthotropic(lamina() + weakening, 1));
  auto const both_to = [&](Mat<3> const& F) { whole.to(F), weak.to(F); };
  double stored = 0;  // of the point when it fails
  for (int n = 1; n <= 1000; ++n) {
    both_to(diagonal(1, 1 + 5e-6 * n, 1));
    if (weak.history("FailureIndex") < 1) {
      EXPECT_EQ(weak.stress(1), whole.stress(1));
      EXPECT_EQ(weak.history("Damage"), 0);
      stored = weak.energy();
    }
  }
  EXPECT_NEAR(weak.history("Damage"), 0.8, 1e-15);
  both_to(diagonal(0.999, 1.001, 1));
  for (int const c : {0, 1, 2}) EXPECT_NEAR(weak.stress(c), 0.2 * whole.stress(c), 1e-12 * 181e9);
  both_to(diagonal(1, 1, 1));
  EXPECT_NEAR(weak.energy(), 0.8 * stored, 0.01 * stored);
}

TEST(Orthotropic, RefusesConstantsThatGiveEnergy) {
  auto const problem = [](Values const& more) { return problem_of_block_law(orthotropic(lamina() + more)); };
  EXPECT_EQ(problem({{"poissons_ratio_12", 4.3}}),
            "the compliance is not positive definite: poissons_ratio_12 4.3 is not within the square root of "
            "youngs_modulus_1 / youngs_modulus_2, 4.192, on both sides of 0");
  EXPECT_NE(problem({{"poissons_ratio_12", 3}, {"poissons_ratio_13", 3}}).find("reduce Poisson"), std::string::npos);
  EXPECT_NE(problem({{"axis_2_x", 1}, {"axis_2_y", 0}}).find("parallel"), std::string::npos);
  EXPECT_NE(problem({{"axis_1_x", 0}}).find("no length"), std::string::npos);
}

}  // namespace
}  // namespace piola::testing
