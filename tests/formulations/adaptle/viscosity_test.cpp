// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/viscosity.hpp"
#include "math/random.hpp"
#include <gtest/gtest.h>

namespace piola::adaptle {
namespace {

using piola::testing::Random;

TEST(AdaptleViscosity, OfOnePairIsAsEquationsSixAndSevenSay) {
  double const h = 1.4e-4;
  // Particles 0.1 mm apart approach at 10 m/s: v.r = -1e-3 m2/s.
  auto const [mu, pressure] = viscous_pair(1.0, 2.0, h, -1e-3, 1e-8, 2 * 5328.0, 2 * 2785.0);
  EXPECT_NEAR(mu, -1.4e-7 / 1.0196e-8, 1e-12);
  // (alpha c |mu| + beta mu^2) / rho
  EXPECT_NEAR(pressure, (5328 * 13.730874852883484 + 2 * 188.53692423619834) / 2785, 1e-11);
  // mu = 1 * -2.02 / 1.01 = -2 with h = 1, r = 1
  EXPECT_NEAR(viscous_pair(0.2, 0.4, 1.0, -2.02, 1.0, 1.16 + 1.16, 2.0).pressure, 0.2 * 1.16 * 2 + 0.4 * 4, 1e-14);
  auto const separating = viscous_pair(1.0, 2.0, h, 1e-3, 1e-8, 2 * 5328.0, 2 * 2785.0);
  EXPECT_EQ(separating.mu, 0);
  EXPECT_EQ(separating.pressure, 0);
}

TEST(AdaptleViscosity, SwitchIsOneInCompressionAndSmallElsewhere) {
  double const c = 5000, h = 1e-3, rate = 1e6, small = 1e-3 * c / h / rate;
  Mat<3> plane{}, round{}, sphere{}, shear{}, turn{}, spread{}, mixed{};
  plane(0, 0) = -rate;
  round(0, 0) = round(1, 1) = -rate;
  sphere(0, 0) = sphere(1, 1) = sphere(2, 2) = -rate;
  shear(0, 1) = rate;
  turn(0, 1) = rate;
  turn(1, 0) = -rate;
  spread(0, 0) = spread(1, 1) = rate;
  EXPECT_NEAR(compression_factor(plane, c, h, 0.05), 1 / (1 + small), 1e-14);
  EXPECT_EQ(compression_factor(round, c, h, 0.05), 1) << "-tr D = 2, sqrt(3/2 D':D') = 1";
  EXPECT_EQ(compression_factor(sphere, c, h, 0.05), 1);
  EXPECT_EQ(compression_factor(shear, c, h, 0.05), 0.05);
  EXPECT_EQ(compression_factor(turn, c, h, 0.05), 0.05);
  EXPECT_EQ(compression_factor(spread, c, h, 0.05), 0.05);
  EXPECT_EQ(compression_factor(Mat<3>{}, c, h, 0.05), 0.05);
  // Uniaxial compression beside as fast a shear: D' = diag(-2, 1, 1)/3 with 1/2 off the diagonal, |rot v| = 1.
  mixed(0, 0) = -rate;
  mixed(0, 1) = rate;
  EXPECT_NEAR(compression_factor(mixed, c, h, 0.05), 1 / (std::sqrt(1.5 * (6.0 / 9 + 0.5)) + 1 + small), 1e-14);
  EXPECT_NEAR(balsara_factor(mixed, c, h), 1 / (1 + 1 + 0.1 * small), 1e-14);
}

template <int D>
SymMat<D> turned(Mat<3> const& Q, Mat<3> const& A) {
  Mat<3> const B = Q * A * transpose(Q);
  SymMat<D> S;
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j) S(i, j) = B(i, j);
  return S;
}

TEST(AdaptleArtificialStress, ActsAlongPrincipalDirectionsInTension) {
  Random random(5);
  double const rho = 2700, epsilon = 0.3;
  for (int k = 0; k < 20; ++k) {
    Mat<3> const Q = random.rotation();
    SymMat<3> const R = artificial_stress<3>(turned<3>(Q, testing::diagonal(3e8, -2e8, 5e7)), rho, epsilon),
                    wanted =
                        turned<3>(Q, testing::diagonal(-epsilon * 3e8 / (rho * rho), 0, -epsilon * 5e7 / (rho * rho)));
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(R.c[c], wanted.c[c], 1e-12 * epsilon * 3e8 / (rho * rho));
    Mat<3> const q = testing::rotation_about({{0, 0, 1}}, random.in(-3, 3));
    SymMat<2> const P = artificial_stress<2>(turned<2>(q, testing::diagonal(-1e8, 4e8, 0)), rho, epsilon),
                    plane = turned<2>(q, testing::diagonal(0, -epsilon * 4e8 / (rho * rho), 0));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(P.c[c], plane.c[c], 1e-12 * epsilon * 4e8 / (rho * rho));
  }
}

TEST(AdaptleArtificialStress, VanishesInCompression) {
  Random random(6);
  for (int k = 0; k < 20; ++k) {
    SymMat<3> const R = artificial_stress<3>(turned<3>(random.rotation(), testing::diagonal(-3e8, -1, -5e7)), 1000, 1);
    for (double const c : R.c) EXPECT_NEAR(c, 0, 1e-12 * 300);
    Mat<3> const q = testing::rotation_about({{0, 0, 1}}, random.in(-3, 3));
    SymMat<2> const P = artificial_stress<2>(turned<2>(q, testing::diagonal(-3e8, -5e7, 0)), 1000, 1);
    for (double const c : P.c) EXPECT_EQ(c, 0);
  }
  SymMat<3> const none = artificial_stress<3>(SymMat<3>{}, 1000, 1);
  for (double const c : none.c) EXPECT_EQ(c, 0);
}

template <class Shape>
void kernel_has_its_slope() {
  double const h = 0.3;
  Kernel<3, Shape> const kernel(h);
  EXPECT_EQ(kernel(2 * h), 0);
  for (double const r : {0.05, 0.2, 0.35, 0.5, 0.599, 0.601}) {
    double s = 0, W = 0, step = 1e-6;
    kernel.evaluate(r * r, s, W);
    EXPECT_NEAR(W, kernel(r), 1e-12 * kernel(0));
    EXPECT_NEAR(s, -(kernel(r + step) - kernel(r - step)) / (2 * step) / r, 1e-5 * kernel(0) / (h * h));
  }
}

TEST(AdaptleKernel, IsTheShapeWithItsSlope) {
  kernel_has_its_slope<CubicSpline>();
  kernel_has_its_slope<WendlandC2>();
}

TEST(AdaptleKernel, IsTheCubicSplineByDefault) {
  double const h = 0.3;
  Kernel<2> const plane(h);
  Kernel<3> const space(h);
  EXPECT_NEAR(plane(0), 10 / (7 * 3.14159265358979 * h * h), 1e-12);
  EXPECT_NEAR(space(0), 1 / (3.14159265358979 * h * h * h), 1e-12);
  EXPECT_NEAR(space(h) / space(0), 0.25, 1e-15);
}

}  // namespace
}  // namespace piola::adaptle
