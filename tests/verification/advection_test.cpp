// SPDX-License-Identifier: Apache-2.0
// Appendix C of Lee et al. (2016): fourth-order dissipation and two-stage Runge-Kutta on the advection equation. A
// scheme of a few lines, kept here because it is where the coefficient eps4 = 1/8 and the limits of alpha_CFL come
// from.
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace piola {
namespace {

using Wave = std::vector<double>;

/// Rate of (C.1) on a periodic row, times dt: central difference and biharmonic, alpha = c dt / h.
Wave rate(Wave const& u, double alpha, double eps4) {
  std::size_t const n = u.size();
  Wave r(n);
  for (std::size_t a = 0; a < n; ++a) {
    double const before2 = u[(a + n - 2) % n], before = u[(a + n - 1) % n], after = u[(a + 1) % n],
                 after2 = u[(a + 2) % n];
    r[a] = -0.5 * alpha * (after - before) - alpha * eps4 * (after2 - 4 * after + 6 * u[a] - 4 * before + before2);
  }
  return r;
}

/// One step of (43).
Wave step(Wave const& u, double alpha, double eps4) {
  Wave star = u, next = u;
  Wave const first = rate(u, alpha, eps4);
  for (std::size_t a = 0; a < u.size(); ++a) star[a] += first[a];
  Wave const second = rate(star, alpha, eps4);
  for (std::size_t a = 0; a < u.size(); ++a) next[a] = 0.5 * (u[a] + star[a] + second[a]);
  return next;
}

/// Amplification of the wave with `waves` periods over n points, from cosine and sine.
std::complex<double> amplification(std::size_t n, double waves, double alpha, double eps4) {
  Wave u(n);
  double const k = 2 * std::numbers::pi * waves / static_cast<double>(n);
  for (std::size_t a = 0; a < n; ++a) u[a] = std::cos(k * static_cast<double>(a));
  Wave const next = step(u, alpha, eps4);
  std::complex<double> sum = 0;
  for (std::size_t a = 0; a < n; ++a) sum += next[a] * std::exp(std::complex<double>(0, -k * static_cast<double>(a)));
  double const norm = waves == 0 || 2 * waves == static_cast<double>(n) ? 1 : 2;
  return sum * norm / static_cast<double>(n);
}

struct Sample {
  double alpha, eps4;
};
class AdvectionEquation : public ::testing::TestWithParam<Sample> {};

/// (C.4): u_t + c u_x = (alpha^2 - 1) c h^2/6 u_xxx - (eps4 - alpha^3/8) c h^3 u_xxxx.
TEST_P(AdvectionEquation, HasTheDispersionAndDissipationOfTheAppendix) {
  auto const [alpha, eps4] = GetParam();
  std::size_t const n = 128;
  double const k = 2 * std::numbers::pi / static_cast<double>(n);  // k h = 0.049
  // log g = alpha (-i k + (alpha^2 - 1)/6 (i k)^3 - (eps4 - alpha^3/8) k^4)
  std::complex<double> const rate = std::log(amplification(n, 1, alpha, eps4)) / alpha;
  double const third = -(rate.imag() + k) / (k * k * k), fourth = -rate.real() / (k * k * k * k);
  EXPECT_NEAR(third, (alpha * alpha - 1) / 6, 2e-3 * k / 0.1);  // the next terms are k^2 smaller
  EXPECT_NEAR(fourth, eps4 - alpha * alpha * alpha / 8, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(All, AdvectionEquation,
                         ::testing::Values(Sample{0.1, 0}, Sample{0.3, 0.125}, Sample{0.5, 0.125},
                                           Sample{0.5, 0.0625}));

bool stable(double alpha, double eps4) {
  for (int waves = 1; waves <= 64; ++waves)
    if (std::abs(amplification(128, waves, alpha, eps4)) > 1 + 1e-12) return false;
  return true;
}

/// Largest stable alpha_CFL, by bisection; the limits are those of Appendix C as the specification measured them.
TEST(AdvectionEquation, IsStableUpToTheLimitsOfTheAppendix) {
  struct {
    double eps4, limit;
  } const published[] = {{1.0 / 64, 0.500}, {1.0 / 32, 0.630}, {1.0 / 16, 0.793}, {1.0 / 8, 1.000}, {1.0 / 4, 0.500}};
  for (auto const& row : published) {
    double low = 0.05, high = 2;
    while (high - low > 1e-4) (stable(0.5 * (low + high), row.eps4) ? low : high) = 0.5 * (low + high);
    EXPECT_NEAR(low, row.limit, 5e-3) << "eps4 = " << row.eps4;
  }
}

TEST(AdvectionEquation, IsUnstableWithoutDissipation) {
  for (double const alpha : {0.05, 0.3, 0.9}) EXPECT_FALSE(stable(alpha, 0));
}

}  // namespace
}  // namespace piola
