// SPDX-License-Identifier: Apache-2.0
// Lee, Gil, Greto, Kulasegaram, Bonet (2016), Appendix C: the advection equation u_t + c u_x = 0 on a periodic row of
// particles, by the passes of jst_sph for sums over neighbours, biharmonic dissipation and Runge-Kutta stages. The
// coefficient eps4 = 1/8 and the limits of alpha = c dt / h come from this equation.
#include "piola/formulations/jst_sph/passes.hpp"
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace piola::jst_sph {
namespace {

using Wave = std::vector<double>;  ///< one value per particle of a periodic row
constexpr Index n = 128;           ///< particles; spacing, wave speed and density are 1

/// Loader of the two adjacent particles, for which the sums of jst_sph are central differences.
struct AdjacentLoader {
  template <class Body>
  void operator()(Index i, Body const& body, double (&sums)[Body::sums]) const {
    for (double& sum : sums) sum = 0;
    auto const own = body.template own<double>(i);
    for (int const side : {-1, 1}) {
      auto const f = body.gathered.template vector<Body::fields, double>((i + side + n) % n);
      PairGeometry<1, double> const g{0.5, {{0.5 * side}}, {{1.0 * side}}, 1, 1, 1, 0};
      body.template pair<false>(sums, own, g, f.c);
    }
  }
};

View in(Wave const& values, int components = 1) { return {values.data(), 1, components}; }
WriteView out(Wave& values) { return {values.data(), 1, 1}; }

/// -T + D with T = c u_x and D = -eps4 c h^3 u_xxxx, (37b) and (C.2).
Wave rate(Wave const& u, double eps4) {
  Wave const zeros(n, 0), ones(n, 1);
  ReferenceView const zero{in(zeros), nullptr}, one{in(ones), nullptr};
  Wave second(2 * u.size()), flux(n), w(n), rate(n), unused(n);
  for (Index i = 0; i < n; ++i) {
    double sums[FirstSums<1, 1>::sums];  // first and second derivative
    AdjacentLoader{}(i, FirstSums<1, 1>{in(u), zero, zero}, sums);
    auto const a = static_cast<std::size_t>(i);
    second[2 * a] = w[a] = sums[1];
    second[2 * a + 1] = flux[a] = -u[a];
  }
  Constants k{};
  k.rho0 = k.kernel_volume = k.h_min = 1;
  k.eps4 = eps4;
  SumForces<1, Biharmonic::literal, 1, AdjacentLoader> const forces{.loader = {},
                                                                    .body = {in(second, 2), zero, zero},
                                                                    .k = k,
                                                                    .A = in(flux),
                                                                    .w = in(w),
                                                                    .V = one,
                                                                    .weight = one,
                                                                    .G = zero,
                                                                    .diagonal = zero,
                                                                    .wave_speed = in(ones),
                                                                    .x = in(zeros),
                                                                    .v = in(zeros),
                                                                    .rate = out(rate),
                                                                    .rate_in = in(zeros),
                                                                    .J_rate = out(unused),
                                                                    .J_rate_in = in(zeros)};
  double total[ForceTotals<1>::size]{};
  for (Index i = 0; i < n; ++i) forces(i, total);
  return rate;
}

/// One step of (43).
Wave advance(Wave u, double alpha, double eps4) {
  Wave u_n(n), x(n), unused(n);
  for (bool const second : {false, true}) {
    Wave const r = rate(u, eps4);
    AdvanceMomentum<1> const stage{{alpha, second}, {},     Variables::pF, in(r),  in(u),      in(u_n),
                                   in(x),           out(u), out(u_n),      out(x), out(unused)};
    for (Index i = 0; i < n; ++i) stage(i);
  }
  return u;
}

/// Amplification of the wave with `waves` periods over the row.
std::complex<double> amplification(int waves, double alpha, double eps4) {
  double const k = 2 * std::numbers::pi * waves / n;
  Wave u(n);
  for (std::size_t a = 0; a < u.size(); ++a) u[a] = std::cos(k * static_cast<double>(a));
  Wave const next = advance(u, alpha, eps4);
  std::complex<double> sum = 0;
  for (std::size_t a = 0; a < u.size(); ++a) sum += next[a] * std::polar(1.0, -k * static_cast<double>(a));
  return sum * (2 * waves == n ? 1.0 : 2.0) / static_cast<double>(n);
}

/// (C.4): u_t + c u_x = (alpha^2 - 1) c h^2/6 u_xxx - (eps4 - alpha^3/8) c h^3 u_xxxx.
TEST(AdvectionEquation, HasTheDispersionAndDissipationOfTheAppendix) {
  double const k = 2 * std::numbers::pi / n;
  for (auto const& [alpha, eps4] : {std::pair{0.1, 0.0}, {0.3, 0.125}, {0.5, 0.125}, {0.5, 0.0625}}) {
    std::complex<double> const rate = std::log(amplification(1, alpha, eps4)) / alpha;
    EXPECT_NEAR(-(rate.imag() + k) / (k * k * k), (alpha * alpha - 1) / 6, 1e-3);  // the next terms are k^2 smaller
    EXPECT_NEAR(-rate.real() / std::pow(k, 4), eps4 - alpha * alpha * alpha / 8, 2e-3);
  }
}

bool is_stable(double alpha, double eps4) {
  for (int waves = 1; 2 * waves <= n; ++waves)
    if (std::abs(amplification(waves, alpha, eps4)) > 1 + 1e-12) return false;
  return true;
}

TEST(AdvectionEquation, IsStableUpToTheLimitsOfTheAppendix) {
  for (auto const& [eps4, limit] :
       {std::pair{1.0 / 64, 0.500}, {1.0 / 32, 0.630}, {1.0 / 16, 0.793}, {1.0 / 8, 1.000}, {1.0 / 4, 0.500}}) {
    EXPECT_TRUE(is_stable(limit - 5e-3, eps4)) << "eps4 = " << eps4;
    EXPECT_FALSE(is_stable(limit + 5e-3, eps4)) << "eps4 = " << eps4;
  }
  EXPECT_FALSE(is_stable(0.05, 0)) << "without dissipation";
}

}  // namespace
}  // namespace piola::jst_sph
