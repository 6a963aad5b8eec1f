// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_advection/wave.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace piola::jst_advection {
namespace {

using Complex = std::complex<double>;

Wave cosine(int n, int m, double size = 1, double phase = 0) {
  Wave u;
  for (int a = 0; a < n; ++a) u.push_back(size * std::cos(2 * std::numbers::pi * m * a / n + phase));
  return u;
}

/// g = 1 + z + z^2/2 with the symbol z of (C.2).
Complex amplification(double kh, double alpha, double eps4) {
  double const second = 2 - 2 * std::cos(kh);
  Complex const z(-alpha * eps4 * second * second, -alpha * std::sin(kh));
  return 1.0 + z + 0.5 * z * z;
}

TEST(AdvectedWave, IsMultipliedByTheSymbolOfTheScheme) {
  int const n = 24;
  for (int m = 1; m <= n / 2; ++m) {
    double const kh = 2 * std::numbers::pi * m / n;
    Wave const u = cosine(n, m);
    Complex const ratio = fourier_coefficient(advance(u, 0.7, 0.1), m) / fourier_coefficient(u, m);
    Complex g = amplification(kh, 0.7, 0.1);
    if (2 * m == n) g = g.real();  // a real checkerboard has no phase
    EXPECT_NEAR(std::abs(ratio - g), 0, 1e-13) << "mode " << m;
  }
}

TEST(AdvectedWave, KeepsItsMean) {
  Wave u = cosine(10, 3);
  for (double& value : u) value += 2;
  Wave const next = advance(u, 0.4, 0.125);
  EXPECT_NEAR(fourier_coefficient(next, 0).real(), 2, 1e-14);
}

TEST(AdvectedWave, IsKnownByItsStrongestMode) {
  Wave u = cosine(30, 4, 1);
  Wave const more = cosine(30, 7, 1.5, 0.3), constant(30, 5);
  for (std::size_t a = 0; a < u.size(); ++a) u[a] += more[a] + constant[a];
  EXPECT_EQ(dominant_mode(u), 7) << "the mean is no mode";
  EXPECT_NEAR(std::abs(fourier_coefficient(u, 7)), 0.75, 1e-14);
  EXPECT_NEAR(level(cosine(30, 4)), std::sqrt(0.5), 1e-14);
}

TEST(NumericalErrors, AreReadFromLagAndLoss) {
  // A mode that travelled 50 spacings, 2 % too slowly, and kept 0.9 of its size.
  double const kh = 0.2, distance = 50;
  NumericalError const error = numerical_error(std::polar(0.9, -0.98 * kh * distance), kh, distance);
  EXPECT_NEAR(error.dispersion, -6 * 0.02 / (kh * kh), 1e-10);
  EXPECT_NEAR(error.diffusion, -std::log(0.9) / (distance * std::pow(kh, 4)), 1e-10);
}

TEST(NumericalErrors, AreNothingBeforeAnythingMoved) {
  NumericalError const error = numerical_error(1, 0.2, 0);
  EXPECT_EQ(error.dispersion, 0);
  EXPECT_EQ(error.diffusion, 0);
}

}  // namespace
}  // namespace piola::jst_advection
