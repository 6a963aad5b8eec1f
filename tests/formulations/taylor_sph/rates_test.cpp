// SPDX-License-Identifier: Apache-2.0
// The formulas of Taylor-SPH at one point.
#include "piola/formulations/taylor_sph/rates.hpp"
#include "math/random.hpp"
#include <gtest/gtest.h>

namespace piola::taylor_sph {
namespace {

using testing::Random;

constexpr double E = 210, nu = 0.3;  // any unit
constexpr double shear = E / (2 * (1 + nu)), lame = E * nu / ((1 + nu) * (1 - 2 * nu));

LinearElastic law() {
  double const values[] = {8000, E, nu, 0};
  return LinearElastic(values);
}

// ---- turning

/// Anticlockwise at 1 rad/s.
constexpr Mat<2> spin{{0, -1, 1, 0}};

TEST(Turning, HasTheSignsOfATurningFrame) {
  // With w = omega_12 = -1:  ds11 = 2 w s12,  ds22 = -2 w s12,  ds12 = w (s22 - s11).
  auto const rate = turning(SymMat<2>{{1, 0.2, 0.1}}, spin);
  EXPECT_NEAR(rate(0, 0), -0.2, 1e-15);
  EXPECT_NEAR(rate(1, 1), 0.2, 1e-15);
  EXPECT_NEAR(rate(0, 1), 0.8, 1e-15);
  auto const uniaxial = turning(SymMat<2>{{1, 0, 0}}, spin);
  EXPECT_EQ(uniaxial(0, 1), 1);
  EXPECT_EQ(uniaxial(0, 0), 0);
  EXPECT_EQ(uniaxial(1, 1), 0);
}

TEST(Turning, DoesNotSeeTheSymmetricPartOfTheVelocityGradient) {
  Mat<2> const strained = spin + Mat<2>{{3, 0.7, 0.7, -2}};
  SymMat<2> const s{{1, 0.2, 0.1}};
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(turning(s, strained).c[c], turning(s, spin).c[c], 1e-15);
  EXPECT_EQ(turning(SymMat<1>{{5}}, Mat<1>{{3}}).c[0], 0) << "there is no spin in one dimension";
}

TEST(Turning, OfThreeDimensionsIsTheRateOfATurningTensor) {
  Random random(1);
  for (int k = 0; k < 50; ++k) {
    Mat<3> const A = random.matrix(1), W = 0.5 * (A - transpose(A));
    SymMat<3> s;
    for (double& c : s.c) c = random.in(-1, 1);
    auto const rate = turning(s, A);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        double expected = 0;
        for (int m = 0; m < 3; ++m) expected += W(i, m) * s(m, j) - s(i, m) * W(m, j);
        EXPECT_NEAR(rate(i, j), expected, 1e-15);
      }
  }
}

/// A stress carried along by the two half steps of the scheme, n times, through an angle.
SymMat<2> turned(SymMat<2> s, double angle, int n) {
  double const dt = angle / n;
  for (int k = 0; k < n; ++k) {
    SymMat<2> const first = turning(s, spin);
    SymMat<2> half = s;
    for (int c = 0; c < 3; ++c) half.c[c] += 0.5 * dt * first.c[c];
    SymMat<2> const second = turning(half, spin);
    for (int c = 0; c < 3; ++c) s.c[c] += dt * second.c[c];
  }
  return s;
}
double distance(SymMat<2> const& a, SymMat<2> const& b) {
  double most = 0;
  for (int c = 0; c < 3; ++c) most = std::fmax(most, std::fabs(a.c[c] - b.c[c]));
  return most;
}

TEST(Turning, CarriesAStressRoundWithSecondOrder) {
  constexpr double right_angle = 1.5707963267948966;
  SymMat<2> const start{{1, 0.2, 0.1}}, half{{0.5, 0.7, 0.4}}, quarter{{0.2, 1, -0.1}};
  EXPECT_LT(distance(turned(start, 0.5 * right_angle, 20000), half), 1e-8);
  EXPECT_LT(distance(turned(start, right_angle, 20000), quarter), 1e-8);
  EXPECT_LT(distance(turned(start, 4 * right_angle, 40000), start), 1e-7);
  double const coarse = distance(turned(start, right_angle, 50), quarter);
  double const fine = distance(turned(start, right_angle, 100), quarter);
  EXPECT_NEAR(coarse / fine, 4, 0.1);
}

// ---- D : d

Mat<1> stretch() { return {{2}}; }

TEST(ElasticRate, OfABarIsYoungsModulus) {
  double const free = lame / (2 * (lame + shear));  // = nu
  EXPECT_NEAR(free, nu, 1e-15);
  auto const rate = elastic_rate<1>(law(), free, stretch());
  EXPECT_NEAR(rate.in_plane(0, 0), 2 * E, 1e-12 * E);
  EXPECT_NEAR(rate.across, 0, 1e-12 * E);
}

TEST(ElasticRate, OfUniaxialStrainIsThePWaveModulus) {
  auto const rate = elastic_rate<1>(law(), 0, stretch());
  EXPECT_NEAR(rate.in_plane(0, 0), 2 * E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), 1e-12 * E);
  EXPECT_NEAR(rate.across, 2 * lame, 1e-12 * E);
}

/// d = (0.5, -0.2, 2 d12 = 0.3).
constexpr Mat<2> strained{{0.5, 0.1, 0.2, -0.2}};

TEST(ElasticRate, OfPlaneStressIsThatOfAThinPlate) {
  auto const rate = elastic_rate<2>(law(), lame / (lame + 2 * shear), strained);
  double const D11 = E / (1 - nu * nu);
  EXPECT_NEAR(rate.in_plane(0, 0), D11 * (0.5 - 0.2 * nu), 1e-12 * E);
  EXPECT_NEAR(rate.in_plane(1, 1), D11 * (0.5 * nu - 0.2), 1e-12 * E);
  EXPECT_NEAR(rate.in_plane(0, 1), shear * 0.3, 1e-12 * E);
  EXPECT_NEAR(rate.across, 0, 1e-12 * E);
}

TEST(ElasticRate, OfPlaneStrainHasAStressAcross) {
  auto const rate = elastic_rate<2>(law(), 0, strained);
  double const c = E / ((1 + nu) * (1 - 2 * nu));
  EXPECT_NEAR(rate.in_plane(0, 0), c * (0.5 * (1 - nu) - 0.2 * nu), 1e-12 * E);
  EXPECT_NEAR(rate.in_plane(1, 1), c * (0.5 * nu - 0.2 * (1 - nu)), 1e-12 * E);
  EXPECT_NEAR(rate.in_plane(0, 1), shear * 0.3, 1e-12 * E);
  EXPECT_NEAR(rate.across, nu * (rate.in_plane(0, 0) + rate.in_plane(1, 1)), 1e-12 * E);
}

TEST(ElasticRate, OfThreeDimensionsIsHookesLaw) {
  Random random(2);
  for (int k = 0; k < 20; ++k) {
    Mat<3> const L = random.matrix(1);
    auto const rate = elastic_rate<3>(law(), 0.77, L);  // there are no other directions
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(rate.in_plane(i, j), shear * (L(i, j) + L(j, i)) + (i == j ? lame * trace(L) : 0), 1e-12 * E);
  }
}

TEST(StressRate, TurnsInAMovingBodyOnly) {
  SymMat<2> const sigma{{1, 0.2, 0.1}};
  Constants k{};
  auto const fixed = stress_rate<2>(law(), k, spin, sigma);
  for (double const c : fixed.in_plane.c) EXPECT_EQ(c, 0);
  k.moving = true;
  auto const moving = stress_rate<2>(law(), k, spin, sigma);
  EXPECT_NEAR(moving.in_plane(0, 1), 0.8, 1e-15);
  EXPECT_EQ(moving.across, 0) << "a spin in the plane does not touch the stress across it";
}

// ---- volume, divergence

TEST(Volume, AfterAStepIsTheInverseOfTheDensity) {
  // rho (1 - dt tr/2) / (1 + dt tr/2)
  EXPECT_DOUBLE_EQ(volume_after(2.0, 3.0, 0.1), 2 * 1.15 / 0.85);
  EXPECT_DOUBLE_EQ(volume_after(2.0, -3.0, 0.1), 2 * 0.85 / 1.15);
  EXPECT_EQ(volume_after(2.0, 0.0, 0.1), 2);
  // Third order in one step: exp(x) = (1 + x/2) / (1 - x/2) + O(x^3).
  EXPECT_NEAR(volume_after(1.0, 1.0, 1e-3), std::exp(1e-3), 1e-10);
  EXPECT_NEAR(volume_after(volume_after(1.0, 1.0, 0.3), -1.0, 0.3), 1, 1e-15);
}

/// gradient[c][a] of field c.
template <int D>
Estimate<D, double> numbered_gradients() {
  Estimate<D, double> e{};
  for (int c = 0; c < Record<D>::fields; ++c)
    for (int a = 0; a < D; ++a) e.gradient[c][a] = 10 * c + a;
  return e;
}

TEST(Gradients, OfVelocityAndStressAreTakenFromTheirFields) {
  // Fields of 3D: v 0..2, XX 3, YY 4, ZZ 5, XY 6, YZ 7, XZ 8.
  auto const three = numbered_gradients<3>();
  EXPECT_EQ(velocity_gradient<3>(three)(1, 2), 12);
  Vec<3> const force = divergence<3>(three);
  EXPECT_EQ(force[0], 30 + 61 + 82);  // d XX / dx + d XY / dy + d XZ / dz
  EXPECT_EQ(force[1], 60 + 41 + 72);
  EXPECT_EQ(force[2], 80 + 71 + 52);
  // 2D: v 0, 1, XX 2, YY 3, XY 4.
  auto const two = numbered_gradients<2>();
  EXPECT_EQ(velocity_gradient<2>(two)(1, 0), 10);
  EXPECT_EQ(divergence<2>(two)[0], 20 + 41);
  EXPECT_EQ(divergence<2>(two)[1], 40 + 31);
  EXPECT_EQ(divergence<1>(numbered_gradients<1>())[0], 10);
}

}  // namespace
}  // namespace piola::taylor_sph
