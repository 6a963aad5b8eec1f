// SPDX-License-Identifier: Apache-2.0
// Examples 4.1 and 4.2 of Serroukh and Mabssout (2022) and the amplification factor of the scheme in one dimension.
#include "formulations/taylor_sph/taylor_bodies.hpp"
#include <complex>
#include <numbers>

namespace piola {
namespace {

using namespace testing;

// ---- example 4.1: one end of a bar is driven at 10 m/s for 2.5 ms, the other is held

constexpr int n_bar = 101;
constexpr double E = 80e6, rho = 2000, c = 200, dx = 0.01, v0 = 10;
constexpr double loading = 2.5e-3;

Assembly shock_bar(double smoothing_length) {
  Assembly a = assemble_taylor(unit_box(1, n_bar), material("linear_elastic", rho, E, 0));
  choose(a, "configuration", "fixed");
  choose(a, "smoothing_length", smoothing_length);
  // The load ends between two steps, so that round-off of the time does not matter.
  drive(a, {true, false, false}, {"t < 2.5001e-3 ? 10 : 0", "0", "0"}, [](Point const& X) { return X[0] < 1e-9; });
  support(a, {true, false, false}, [](Point const& X) { return X[0] > 1 - 1e-9; });
  return a;
}

struct State {
  double v, sigma;
};

/// d'Alembert's solution by images, v = sum (a_k - b_k), sigma = -(E/c) sum (a_k + b_k) with
/// a_k = g(t - (x + 2kL)/c), b_k = g(t - (2(k + 1)L - x)/c); L = 1 m.
State exact(double x, double t) {
  auto const g = [](double s) { return s > 0 && s < loading + 1e-9 ? v0 : 0; };
  State r{0, 0};
  for (int k = 0; k < 4; ++k) {
    double const a = g(t - (x + 2 * k) / c), b = g(t - (2 * (k + 1) - x) / c);
    r.v += a - b;
    r.sigma -= E / c * (a + b);
  }
  return r;
}

/// Fronts lie between steps: the exact solution is taken a quarter of a step earlier.
TEST(TaylorBarShock, IsExactAtCourantNumberOne) {
  double const dt = dx / c;
  auto const f = make_formulation(shock_bar(0.6));
  EXPECT_NEAR(f->stable_time_step(), dt, 1e-15);
  double worst_v = 0, worst_stress = 0;
  for (int n = 1; n <= 400; ++n) {
    f->step((n - 1) * dt, dt);
    Values const v = sample(*f, "Velocity", n_bar), s = sample(*f, "CauchyStress", n_bar);
    for (std::size_t k = 0; k < n_bar; ++k) {
      State const e = exact(dx * static_cast<double>(k), n * dt - dt / 4);
      // The ends move with their prescribed velocity of this very time.
      double const known = k == 0 ? (n <= 50 ? v0 : 0) : k == n_bar - 1 ? 0 : e.v;
      worst_v = std::max(worst_v, std::fabs(v[3 * k] - known));
      worst_stress = std::max(worst_stress, std::fabs(s[6 * k] - e.sigma));
    }
  }
  EXPECT_LT(worst_v, 1e-11 * v0);
  EXPECT_LT(worst_stress, 1e-11 * 8e6);
}

TEST(TaylorBarShock, HasTheVelocityInTheMiddleThatThePaperShows) {
  double const dt = dx / c;
  auto const f = make_formulation(shock_bar(0.6));
  for (int n = 1; n <= 210; ++n) {
    f->step((n - 1) * dt, dt);
    double const v = sample(*f, "Velocity", n_bar)[3 * 50];
    // The front arrives with step 51, the end of the pulse 50 steps later, both come back after 100 more.
    double const expected = n > 50 && n <= 100 ? 10 : n > 150 && n <= 200 ? -10 : 0;
    EXPECT_NEAR(v, expected, 1e-11) << "step " << n;
  }
}

TEST(TaylorBarShock, HasTheEnergiesOfItsPulse) {
  double const dt = dx / c;
  auto const f = make_formulation(shock_bar(0.6));
  struct Row {
    double time, kinetic, strain;
  };
  std::vector<Row> const rows{{1.25e-3, 24500, 24500},
                              {3.75e-3, 50000, 50000},
                              {6.25e-3, 1000, 99000},
                              {7.5e-3, 49000, 51000},
                              {8.75e-3, 50000, 50000}};
  std::size_t next = 0;
  for (int n = 1; n <= 400; ++n) {
    f->step((n - 1) * dt, dt);
    Diagnostics const d = f->diagnose();
    if (next < rows.size() && n == static_cast<int>(std::lround(rows[next].time / dt))) {
      EXPECT_NEAR(d.kinetic_energy, rows[next].kinetic, 1e-9 * 1e5) << rows[next].time;
      EXPECT_NEAR(d.strain_energy, rows[next].strain, 1e-9 * 1e5) << rows[next].time;
      ++next;
    }
    if (n > 50) {
      EXPECT_NEAR(d.total_energy(), 1e5, 1e-9 * 1e5) << n;
      EXPECT_NEAR(d.external_work, 1e5, 1e-9 * 1e5) << n;
    }
  }
  EXPECT_EQ(next, rows.size());
}

/// Relative error of the stress at the held end over 10 ms, in percent.
double error_at_the_end(double smoothing_length, double courant) {
  double const dt = courant * dx / c;
  auto const f = make_formulation(shock_bar(smoothing_length));
  double error = 0, size = 0;
  for (int n = 1; n * dt < 10e-3 + 1e-9; ++n) {
    f->step((n - 1) * dt, dt);
    double const found = sample(*f, "CauchyStress", n_bar)[6 * (n_bar - 1)], known = exact(1, n * dt - dt / 4).sigma;
    error += (found - known) * (found - known);
    size += known * known;
  }
  return 100 * std::sqrt(error / size);
}

/// Tables 1 and 2: wider kernels and smaller steps are worse, by about what an independent code finds (19.7, 23.5, 20.7
/// and 24.0 %) and the paper (16.8, 25.7, 17.4 and 27.1 %).
TEST(TaylorBarShock, LosesItsExactnessWithWiderKernelsAndSmallerSteps) {
  EXPECT_LT(error_at_the_end(0.6, 1), 1e-9);
  double const wide = error_at_the_end(0.9, 1), wider = error_at_the_end(1.1, 1);
  double const small = error_at_the_end(0.6, 0.5), smaller = error_at_the_end(0.6, 0.1);
  EXPECT_NEAR(wide, 19.72, 4);
  EXPECT_NEAR(wider, 23.46, 4);
  EXPECT_NEAR(small, 20.65, 4);
  EXPECT_NEAR(smaller, 23.96, 4);
  EXPECT_LT(wide, wider);
  EXPECT_LT(small, smaller);
}

TEST(TaylorBarShock, BlowsUpWithinAHundredStepsAboveCourantNumberOne) {
  double const dt = 1.05 * dx / c;
  auto const f = make_formulation(shock_bar(0.6));
  advance(*f, dt, 100);
  EXPECT_GT(std::fabs(largest(sample(*f, "CauchyStress", n_bar))), 1000 * 8e6);
}

// ---- amplification factor

/// Waves to the right, v = cos(k j), sigma = -rho c v, far from the ends: after n steps v = Re(G^n e^(ikj)) with
/// G = 1 - iC sin k - C^2 (1 - cos k).
class TaylorAmplification : public ::testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(TaylorAmplification, IsThatOfTheTwoStepScheme) {
  double const courant = std::get<0>(GetParam()), wave = std::get<1>(GetParam());
  int const n = 41, steps = 10;
  double const spacing = 1.0 / (n - 1), speed = std::sqrt(youngs_modulus / density);
  Assembly a = assemble_taylor(unit_box(1, n));
  choose(a, "configuration", "fixed");
  auto const phase = [&](Point const& X) { return wave * (X[0] / spacing - 20); };
  give_velocity(a, [&](Point const& X) { return Point{std::cos(phase(X)), 0, 0}; });
  auto const f = make_formulation(a);
  give_stress(*f, a, [&](Point const& X) { return std::array{-density * speed * std::cos(phase(X))}; });
  std::complex<double> const G{1 - courant * courant * (1 - std::cos(wave)), -courant * std::sin(wave)};
  std::complex<double> expected = 1;
  for (int s = 1; s <= steps; ++s) {
    f->step(s * 1e-3, courant * spacing / speed);
    expected *= G;
    Values const v = sample(*f, "Velocity", n), stress = sample(*f, "CauchyStress", n);
    for (int j = -(19 - steps); j <= 19 - steps; ++j) {
      auto const k = static_cast<std::size_t>(20 + j);
      double const known = std::real(expected * std::polar(1.0, wave * j));
      EXPECT_NEAR(v[3 * k], known, 1e-12) << s << " " << j;
      EXPECT_NEAR(stress[6 * k], -density * speed * known, 1e-12 * density * speed) << s << " " << j;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, TaylorAmplification,
                         ::testing::Combine(::testing::Values(0.1, 0.5, 0.9, 1.0),
                                            ::testing::Values(0.2, 0.7, std::numbers::pi / 2, 2.5, std::numbers::pi)));

// ---- example 4.2: the fundamental mode of a bar with fixed ends

/// Largest errors over the bar after a quarter of a period, relative to the amplitudes: displacement and stress.
std::pair<double, double> quarter_period_error(int n) {
  constexpr double pi = std::numbers::pi;
  double const amplitude = 1e-6;  // of the velocity over that of sound: nothing is seen of the motion of particles
  double const speed = std::sqrt(youngs_modulus / density), end = 0.5 / speed;
  Assembly a = assemble_taylor(unit_box(1, n));
  give_velocity(a, [&](Point const& X) { return Point{amplitude * speed * std::sin(pi * X[0]), 0, 0}; });
  support(a, {true, false, false}, [](Point const& X) { return X[0] < 1e-9 || X[0] > 1 - 1e-9; });
  auto const f = make_formulation(a);
  int const steps = n - 1;  // Courant number 1/2
  advance(*f, end / steps, steps);
  Values const u = sample(*f, "Displacement", a.particles.X.size()),
               s = sample(*f, "CauchyStress", a.particles.X.size());
  double worst_u = 0, worst_stress = 0;
  for (std::size_t k = 0; k < a.particles.X.size(); ++k) {
    double const x = a.particles.X[k][0];
    worst_u = std::max(worst_u, std::fabs(u[3 * k] - amplitude / pi * std::sin(pi * x)));
    worst_stress = std::max(worst_stress, std::fabs(s[6 * k] - amplitude * youngs_modulus * std::cos(pi * x)));
  }
  return {worst_u / (amplitude / pi), worst_stress / (amplitude * youngs_modulus)};
}

TEST(TaylorStandingWave, InABarIsOfSecondOrder) {
  std::pair<double, double> error[3];
  int const n[] = {11, 21, 41};
  for (int k = 0; k < 3; ++k) error[k] = quarter_period_error(n[k]);
  EXPECT_LT(error[2].first, 1e-3);
  EXPECT_LT(error[2].second, 3e-3);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(std::log2(error[k].first / error[k + 1].first), 2, 0.2) << error[k].first << " " << error[k + 1].first;
    // Of the stress the error of second order vanishes at this time, with the velocity.
    EXPECT_GT(std::log2(error[k].second / error[k + 1].second), 1.8) << error[k].second << " " << error[k + 1].second;
  }
}

// ---- balances of a free bar

/// At Courant number 1 waves only change places: momentum and energy of any motion are those of the start.
TEST(TaylorFreeBar, KeepsMomentumAndEnergyOfAnyMotion) {
  int const n = 31;
  double const dt = 1.0 / (n - 1) / std::sqrt(youngs_modulus / density);
  Assembly a = assemble_taylor(unit_box(1, n));
  choose(a, "configuration", "fixed");
  testing::Random random(1);
  give_velocity(a, [&](Point const&) { return Point{random.in(-1, 2), 0, 0}; });
  auto const f = make_formulation(a);
  Diagnostics const before = f->diagnose();
  for (int k = 0; k < 100; ++k) {
    f->step(k * dt, dt);
    EXPECT_NEAR(f->diagnose().linear_momentum[0], before.linear_momentum[0], 1e-11 * density) << k;
  }
  // After two periods of the bar it moves as in the beginning.
  auto const g = make_formulation(a);
  advance(*g, dt, 2 * (n - 1));
  EXPECT_LT(largest_difference(sample(*g, "Velocity", n), sample(*make_formulation(a), "Velocity", n)), 1e-11);
  EXPECT_LT(largest(sample(*g, "CauchyStress", n)), 1e-11 * density * 10);
  EXPECT_NEAR(g->diagnose().total_energy(), before.total_energy(), 1e-11 * before.total_energy());
}

}  // namespace
}  // namespace piola
