// SPDX-License-Identifier: Apache-2.0
// Hardening by formula and by table, and the effect of rate of Cowper and Symonds, against closed forms and an ordinary
// differential equation of one point.
#include "materials/solid_samples.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace piola {
namespace {

constexpr double E = 70e9, nu = 0.33, three_mu = 3 * E / (2 * (1 + nu));

template <class Strength>
MaterialParameters metal(NamedValues const& given) {
  MaterialParameters m = parameters_by_name(Strength::name, "elastic", "none",
                                            {{"density", 2700}, {"youngs_modulus", E}, {"poissons_ratio", nu}});
  set_parameters(m, given);
  return m;
}

/// The point of a bar under uniaxial stress: its deviator is proportional to diag(2, -1, -1), so the deviatoric strain
/// alone decides. `rate`: of the equivalent strain.
template <class Law>
SolidHistory drawn(Law const& law, double strain, double time, int steps) {
  SolidHistory h;
  h.temperature = 293;
  Mat<3> L;
  L(0, 0) = strain / time, L(1, 1) = L(2, 2) = -0.5 * L(0, 0);
  double const dt = time / steps;
  for (int k = 0; k < steps; ++k) {
    SymMat<3> trial = h.S;
    SymMat<3> const rate = law.deviator_rate(h.S, L);
    for (int c = 0; c < 6; ++c) trial.c[c] += dt * rate.c[c];
    law.update(h, trial, 0, law.rho0, dt);
  }
  return h;
}

/// Stress at a strain: q = sy(e - q/(3 mu)), by bisection.
template <class Curve>
double stress_at(double strain, Curve const& sy) {
  double low = 0, high = three_mu * strain;
  for (int k = 0; k < 200; ++k) {
    double const q = 0.5 * (low + high);
    (q < sy(strain - q / three_mu) ? low : high) = q;
  }
  return low;
}

double voce(double ep) { return 200e6 + 150e6 * (1 - std::exp(-18 * ep)) + 80e6 * ep; }
double linear(double ep) { return 300e6 + 1e9 * ep; }
/// The table of solid_samples.hpp.
double tabulated(double ep) {
  if (ep < 0.02) return 479e6 + (550e6 - 479e6) * ep / 0.02;
  if (ep < 0.1) return 550e6 + (640e6 - 550e6) * (ep - 0.02) / 0.08;
  return ep < 0.5 ? 640e6 + (700e6 - 640e6) * (ep - 0.1) / 0.4 : 700e6;
}

template <class Strength, class Curve>
void expect_curve(MaterialParameters const& material, Curve const& sy) {
  Solid<Strength, ElasticEos> const law(material);
  for (double const strain : {0.004, 0.01, 0.03, 0.2, 1.0})
    for (int const steps : {1, 7, 50}) {
      SolidHistory const h = drawn(law, strain, 1, steps);
      double const q = stress_at(strain, sy);
      EXPECT_NEAR(von_mises(h.S), q, 1e-12 * q) << Strength::name << " " << strain << " " << steps;
      EXPECT_NEAR(h.plastic_strain, strain - q / three_mu, 1e-14) << Strength::name << " " << strain << " " << steps;
    }
}

NamedValues const voce_values{{"yield_stress", 200e6}, {"voce_q", 150e6}, {"voce_b", 18}, {"hardening_modulus", 80e6}};
NamedValues const linear_values{{"yield_stress", 300e6}, {"hardening_modulus", 1e9}};

TEST(HardeningCurves, AreThoseOfABarUnderUniaxialStress) {
  expect_curve<Voce>(metal<Voce>(voce_values), voce);
  expect_curve<IsotropicHardening>(metal<IsotropicHardening>(linear_values), linear);
  expect_curve<TabulatedHardening>(metal<TabulatedHardening>({}), tabulated);
}

TEST(HardeningCurves, HaveTheSlopeOfTheirValues) {
  HardeningCurve const formula{.yield = 2e8, .modulus = 8e7, .q = 1.5e8, .b = 18};
  HardeningCurve table;
  table.table = metal<TabulatedHardening>({}).table;
  for (HardeningCurve const& curve : {formula, table})
    for (double const strain : {1e-3, 0.015, 0.07, 0.3, 0.7}) {
      double const step = 1e-5, slope = (curve.at(strain + step).value - curve.at(strain - step).value) / (2 * step);
      EXPECT_NEAR(curve.at(strain).slope, slope, 1e-6 * 1e9) << strain;
    }
  EXPECT_EQ(table.at(0).value, 479e6);
  EXPECT_EQ(table.at(0.1).value, 640e6);
  EXPECT_EQ(table.at(9).value, 700e6);
}

/// Solids of the registry carry the part that the laws share.
TEST(HardeningLaws, RunAsOneTypeOfSolid) {
  for (MaterialParameters const& m : {metal<Voce>(voce_values), metal<TabulatedHardening>({})}) {
    int calls = 0;
    with_solid(m, [&](auto const& solid) {
      ++calls;
      EXPECT_TRUE((std::is_same_v<std::decay_t<decltype(solid)>, Solid<IsotropicHardening, ElasticEos>>));
      EXPECT_EQ(solid.rho0, 2700);
      EXPECT_EQ(solid.spall_pressure, unbounded) << "the parameters after those of the strength";
      double const expected = law_of(m).table != nullptr ? tabulated(0.3) : voce(0.3);
      EXPECT_DOUBLE_EQ(solid.yield_stress({.plastic_strain = 0.3}, 0), expected);
    });
    EXPECT_EQ(calls, 1);
  }
}

/// 1 + (rate/C)^(1/p) of mild steel, C = 40 /s and p = 5: twice the stress at 40 /s, 1 + 25^(1/5) times at 1000 /s.
TEST(CowperSymondsStress, HasTheValuesOfTheFormula) {
  auto values = linear_values;
  values.insert(values.end(), {{"cowper_symonds_c", 40}, {"cowper_symonds_p", 5}});
  Solid<IsotropicHardening, ElasticEos> const law(metal<IsotropicHardening>(values));
  EXPECT_EQ(law.yield_stress({}, 0), 300e6);
  EXPECT_EQ(law.yield_stress({}, 40), 600e6);
  EXPECT_NEAR(law.yield_stress({}, 1000), 300e6 * 2.903653938715878, 1);
  EXPECT_NEAR(law.yield_stress({.plastic_strain = 0.1}, 1000), 400e6 * 2.903653938715878, 1);
}

/// Without hardening the stress of a long pull at a constant rate is s0 (1 + (rate/C)^(1/p)).
TEST(CowperSymondsStress, IsThatOfAConstantRateWithoutHardening) {
  for (double const p : {1.0, 4.0, 10.0})
    for (double const rate : {1e-3, 1.0, 1e3, 1e6}) {
      Solid<IsotropicHardening, ElasticEos> const law(
          metal<IsotropicHardening>({{"yield_stress", 300e6}, {"cowper_symonds_c", 6500}, {"cowper_symonds_p", p}}));
      double const wanted = 300e6 * (1 + std::pow(rate / 6500, 1 / p));
      double const strain = 40 * wanted / three_mu;
      SolidHistory const h = drawn(law, strain, strain / rate, 400);
      EXPECT_NEAR(von_mises(h.S), wanted, 1e-9 * wanted) << p << " " << rate;
    }
}

/// dq/dt = 3 mu (rate - C (q/sy(ep) - 1)^p), by the method of Runge and Kutta of fourth order.
template <class Curve>
double overstress(Curve const& sy, double rate, double C, double p, double strain) {
  constexpr int steps = 400000;
  double const dt = strain / rate / steps;
  double q = 0, ep = 0;
  auto const flow = [&](double stress, double plastic) {
    double const over = stress / sy(plastic) - 1;
    return over > 0 ? C * std::pow(over, p) : 0;
  };
  for (int k = 0; k < steps; ++k) {
    double const f1 = flow(q, ep), q1 = three_mu * (rate - f1);
    double const f2 = flow(q + dt / 2 * q1, ep + dt / 2 * f1), q2 = three_mu * (rate - f2);
    double const f3 = flow(q + dt / 2 * q2, ep + dt / 2 * f2), q3 = three_mu * (rate - f3);
    double const f4 = flow(q + dt * q3, ep + dt * f3), q4 = three_mu * (rate - f4);
    q += dt / 6 * (q1 + 2 * q2 + 2 * q3 + q4);
    ep += dt / 6 * (f1 + 2 * f2 + 2 * f3 + f4);
  }
  return q;
}

template <class Strength, class Curve>
void expect_overstress(NamedValues values, Curve const& sy) {
  double const C = 6500, p = 4, strain = 0.08;
  values.insert(values.end(), {{"cowper_symonds_c", C}, {"cowper_symonds_p", p}});
  Solid<Strength, ElasticEos> const law(metal<Strength>(values));
  for (double const rate : {1.0, 2e3}) {
    // The return mapping is of first order in the step; two of them give the limit.
    double const coarse = von_mises(drawn(law, strain, strain / rate, 4000).S);
    double const fine = von_mises(drawn(law, strain, strain / rate, 8000).S);
    double const exact = overstress(sy, rate, C, p, strain);
    EXPECT_NEAR(2 * fine - coarse, exact, 1e-6 * exact) << Strength::name << " " << rate;
    EXPECT_GT(exact, sy(strain) * 1.05) << "the rate counts";
  }
}

TEST(CowperSymondsStress, FollowsTheDifferentialEquationOfOnePoint) {
  expect_overstress<IsotropicHardening>(linear_values, linear);
  expect_overstress<Voce>(voce_values, voce);
  expect_overstress<TabulatedHardening>({}, tabulated);
}

TEST(CowperSymondsReturn, EndsOnTheYieldSurfaceToRoundOff) {
  HardeningCurve const formula{.yield = 2e8, .modulus = 8e7, .q = 1.5e8, .b = 18};
  for (double const p : {1.0, 2.5, 5.0, 10.0})
    for (double const C : {1e-2, 40.0, 1e7})
      for (double const dt : {1e-12, 1e-7, 1.0})
        for (double const over : {1 + 1e-15, 1.0001, 1.7, 300.0})
          for (double const strain : {0.0, 0.05}) {
            double const values[] = {formula.yield, formula.q, formula.b, formula.modulus, C, p};
            Voce const law(values, Heat());
            FlowState const s{.plastic_strain = strain};
            double const mises = over * law.yield_stress(s, 0), x = law.increment(mises, three_mu, s, dt);
            ASSERT_TRUE(x >= 0 && std::isfinite(x));
            double const yield = formula.at(strain + x).value * CowperSymonds(values + 4).factor(x / dt);
            EXPECT_NEAR(mises - three_mu * x, yield, 1e-14 * mises) << p << " " << C << " " << dt << " " << over;
          }
}

}  // namespace
}  // namespace piola
