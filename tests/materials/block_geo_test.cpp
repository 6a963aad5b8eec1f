// SPDX-License-Identifier: Apache-2.0
// Laws of soil, rock, composites and porous solids on blocks of points.
#include "piola/verification/block_law_battery.hpp"
#include "materials/driven_point.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace piola::testing {
namespace {

constexpr double degrees = std::numbers::pi / 180;

void expect_battery(MaterialParameters const& m) {
  EXPECT_EQ(problem_of_block_law(m), "");
  for (LawCheck const& check : check_block_law(m)) EXPECT_TRUE(check.passed()) << check.what << ": " << check.value;
}

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
