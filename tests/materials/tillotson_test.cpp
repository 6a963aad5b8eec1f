// SPDX-License-Identifier: Apache-2.0
// The equation of state of Tillotson with the aluminium of Melosh 1989, table AII.3.
#include "materials/solid_samples.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

constexpr double rho0 = 2700, incipient = 3e6, complete = 13.9e6;

Tillotson aluminium() {
  double const v[] = {0.5, 1.63, 75.2e9, 65e9, 5e6, incipient, complete, 5, 5};
  return {rho0, 1, v};
}

/// Computed by another program from the formulas of the source.
TEST(TillotsonPressure, HasTheValuesOfTheFormulas) {
  Tillotson const eos = aluminium();
  EXPECT_NEAR(eos.pressure(1.5 * rho0, 2e+07), 1.418808000000e+11, 1.4e+00) << "compressed";
  EXPECT_NEAR(eos.pressure(0.95 * rho0, 1e+06), 1.107501020408e+09, 1.1e-02) << "expanded, cold";
  EXPECT_NEAR(eos.pressure(0.8 * rho0, 8e+06), 7.517088732835e+09, 7.5e-02) << "between";
  EXPECT_NEAR(eos.pressure(0.5 * rho0, 2e+07), 1.351573631837e+10, 1.4e-01) << "vapour";
  EXPECT_NEAR(eos.pressure(0.9 * rho0, -20000), -6.973518000000e+09, 7.0e-02) << "after tension";
}

TEST(TillotsonPressure, IsContinuousBetweenItsStates) {
  Tillotson const eos = aluminium();
  double const near = 1e-12;
  auto const expect_no_jump = [&](double rho_a, double e_a, double rho_b, double e_b) {
    double const p = eos.pressure(rho_a, e_a);
    EXPECT_NEAR(p, eos.pressure(rho_b, e_b), 1e-9 * (std::fabs(p) + 75.2e9)) << rho_a / rho0 << " " << e_a;
  };
  for (double const e : {-1e5, 0.0, 1e6, incipient, 8e6, complete, 5e7})
    expect_no_jump(rho0 * (1 - near), e, rho0 * (1 + near), e);
  for (double const eta : {0.2, 0.5, 0.9, 0.999})
    for (double const e : {0.0, incipient, complete}) expect_no_jump(eta * rho0, e - 1e-6, eta * rho0, e + 1e-6);
}

TEST(TillotsonPressure, IsThatOfAnIdealGasFarOut) {
  Tillotson const eos = aluminium();
  for (double const eta : {1e-3, 1e-2, 0.1}) EXPECT_DOUBLE_EQ(eos.pressure(eta * rho0, 5e7), 0.5 * eta * rho0 * 5e7);
}

TEST(TillotsonPressure, TakesTheBulkModulusOfTheElasticConstantsWithoutOneOfItsOwn) {
  double const v[] = {0.5, 1.63, 0, 65e9, 5e6, incipient, complete, 5, 5};
  EXPECT_EQ(Tillotson(rho0, 7e10, v).bulk_modulus(), 7e10);
  EXPECT_EQ(aluminium().bulk_modulus(), 75.2e9);
}

struct State {
  double rho, e;
};

/// The energy after a change of density along the isentrope, de = p/rho^2 drho, by the method of Runge and Kutta. Calls
/// f(state, drho) after each step.
template <class F>
State along_isentrope(Tillotson const& eos, State s, double to, int steps, F const& f) {
  double const h = (to - s.rho) / steps;
  auto const slope = [&](double rho, double e) { return eos.pressure(rho, e) / (rho * rho); };
  for (int k = 0; k < steps; ++k) {
    double const a = slope(s.rho, s.e), b = slope(s.rho + h / 2, s.e + h / 2 * a);
    double const c = slope(s.rho + h / 2, s.e + h / 2 * b), d = slope(s.rho + h, s.e + h * c);
    s.e += h / 6 * (a + 2 * b + 2 * c + d);
    s.rho += h;
    f(s, h);
  }
  return s;
}

/// p(end) - p(start) = integral of c^2 over the density, through all states: released from strong shocks.
TEST(TillotsonSoundSpeed, IsTheSlopeOfIsentropesThroughAllStates) {
  Tillotson const eos = aluminium();
  for (State const start : {State{1.3 * rho0, 2e6}, State{1.7 * rho0, 1.2e7}, State{2 * rho0, 4e7}}) {
    double integral = 0, last = eos.sound_speed_squared(start.rho, start.e);
    bool vapour = false;
    State const end =
        along_isentrope(eos, start, (start.e > 1e7 ? 0.5 : 0.9) * rho0, 400000, [&](State const& s, double h) {
          double const c2 = eos.sound_speed_squared(s.rho, s.e);
          integral += 0.5 * h * (last + c2);
          last = c2;
          vapour = vapour || (s.rho < rho0 && s.e > incipient);
        });
    double const p = eos.pressure(start.rho, start.e);
    EXPECT_NEAR(eos.pressure(end.rho, end.e) - p, integral, 1e-6 * p) << start.e;
    EXPECT_EQ(vapour, start.e > 1e7) << start.e;
  }
}

/// The energy on the Hugoniot, e = p (1/rho0 - 1/rho)/2, where the compressed pressure makes it a quadratic equation
/// in e: with k = E0 eta^2, q = rho (1/rho0 - 1/rho)/2 and cold pressure c,
///   e (k + e) = q ((a + b) k e + a e^2) + (c/rho) q (k + e).
TEST(TillotsonHugoniot, IsThatOfTheCompressedStateAndOfExperiments) {
  Tillotson const eos = aluminium();
  double const a = 0.5, b = 1.63;
  for (double const eta : {1.05, 1.2, 1.4, 1.7}) {
    double const m = eta - 1, k = 5e6 * eta * eta, q = m / 2, c = (75.2e9 * m + 65e9 * m * m) / (eta * rho0);
    double const A = 1 - a * q, B = k - q * (a + b) * k - c * q, C = -c * q * k;
    double const exact = (-B + std::sqrt(B * B - 4 * A * C)) / (2 * A), rho = eta * rho0;
    double low = 0, high = 1e9;
    for (int n = 0; n < 100; ++n) {
      double const e = 0.5 * (low + high);
      (e < eos.pressure(rho, e) * (1 / rho0 - 1 / rho) / 2 ? low : high) = e;
    }
    EXPECT_NEAR(low, exact, 1e-9 * exact) << eta;
    double const p = eos.pressure(rho, low), us = std::sqrt(p / (rho0 * m / eta)), up = us * m / eta;
    // Aluminium 2024: us = 5.328 km/s + 1.338 up (Steinberg 1996; Marsh 1980).
    EXPECT_NEAR(us, 5328 + 1.338 * up, 0.04 * us) << eta;
  }
}

}  // namespace
}  // namespace piola
