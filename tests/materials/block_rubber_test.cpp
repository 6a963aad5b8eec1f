// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/block_law.hpp"
#include "piola/math/tensor.hpp"
#include "piola/verification/block_law_battery.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <random>

namespace piola::testing {
namespace {

constexpr double rho0 = 1100, kappa = 50e6, mu = 1e6;

/// A material by the names of its parameters; the others have their defaults.
MaterialParameters material(std::string_view law, std::map<std::string_view, double> const& given) {
  LawInfo const info = find_law(law).value();
  MaterialParameters m;
  m.law = info.index;
  std::size_t found = 0;
  for (std::size_t i = 0; i < info.parameters.size(); ++i) {
    auto const at = given.find(info.parameters[i].name);
    found += at != given.end();
    m.value[i] = at != given.end() ? at->second : info.parameters[i].default_value;
  }
  EXPECT_EQ(found, given.size()) << "unknown parameter";
  return m;
}
MaterialParameters ogden(std::map<std::string_view, double> given) {
  given.insert({{"density", rho0}, {"bulk_modulus", kappa}});
  return material("ogden", given);
}
MaterialParameters viscoelastic(std::map<std::string_view, double> given) {
  given.insert({{"density", rho0}, {"bulk_modulus", kappa}, {"shear_modulus", mu}});
  return material("viscoelastic", given);
}
MaterialParameters eight_chains(double limit) {
  constexpr double nu = (3 * kappa - 2 * mu) / (2 * (3 * kappa + mu));
  return material(
      "arruda_boyce",
      {{"density", rho0}, {"youngs_modulus", 2 * mu * (1 + nu)}, {"poissons_ratio", nu}, {"limiting_stretch", limit}});
}

/// A material point under a law with the first Piola stress.
class Point {
 public:
  explicit Point(MaterialParameters const& m) : law_(m), history_(static_cast<std::size_t>(law_.history_count()) + 1) {
    law_.start(history_.data());
  }
  /// Goes to F in a step of dt and returns the first Piola stress.
  Mat<3> go(Mat<3> const& F, double dt = 0) {
    Mat<3> P;
    double speed = 0;
    time_ += dt;
    piola_points block{1, 1, time_, dt, 0, nullptr, F_.c, F.c, nullptr, nullptr, P.c, &energy, history_.data(), &speed};
    EXPECT_EQ(law_.update(block), 0);
    F_ = F;
    return P;
  }
  double energy = 0;

 private:
  BlockLaw law_;
  std::vector<double> history_;
  Mat<3> F_ = identity<3>();
  double time_ = 0;
};

Mat<3> cauchy(Mat<3> const& P, Mat<3> const& F) { return (1 / determinant(F)) * (P * transpose(F)); }
Mat<3> stretches(double a, double b, double c) { return {{a, 0, 0, 0, b, 0, 0, 0, c}}; }
Mat<3> shear(double gamma) { return {{1, gamma, 0, 0, 1, 0, 0, 0, 1}}; }
Mat<3> stress_at(MaterialParameters const& m, Mat<3> const& F) { return cauchy(Point(m).go(F), F); }
/// Least error allowed of values of this size.
double near(double value) { return 1e-6 * std::abs(value); }

/// Vulcanised rubber of Treloar's tests; shear modulus 0.4225 MPa (Holzapfel, Nonlinear Solid Mechanics, 2000, 6.5).
MaterialParameters treloar() {
  return ogden(
      {{"mu_1", 6.3e5}, {"alpha_1", 1.3}, {"mu_2", 1.2e3}, {"alpha_2", 5.0}, {"mu_3", -1e4}, {"alpha_3", -2.0}});
}
/// Terms of different decades of time.
MaterialParameters four_terms() {
  return viscoelastic({{"g_1", 0.3},
                       {"tau_1", 1e-4},
                       {"g_2", 0.2},
                       {"tau_2", 1e-3},
                       {"g_3", 0.15},
                       {"tau_3", 1e-2},
                       {"g_4", 0.1},
                       {"tau_4", 0.1}});
}
/// G(t)/G(0) of a material of the law viscoelastic.
double relaxation(MaterialParameters const& m, double t) {
  double g = 1;
  for (int i = 0; i < 4; ++i)
    if (double const part = m.value[3 + 2 * i]; part > 0) g -= part * -std::expm1(-t / m.value[4 + 2 * i]);
  return g;
}

TEST(BlockRubber, PassesTheBattery) {
  for (auto const& m :
       {treloar(), ogden({{"mu_1", mu}, {"alpha_1", 2}}), ogden({{"mu_1", -mu}, {"alpha_1", -3.5}}),
        ogden({{"mu_1", 1e3}, {"alpha_1", 25}, {"mu_2", 5e5}, {"alpha_2", 0.1}}), four_terms(), eight_chains(2),
        viscoelastic({{"g_1", 0.9}, {"tau_1", 1e-4}}), viscoelastic({{"g_1", 0.5}, {"tau_1", 1e-7}})})
    for (LawCheck const& check : check_block_law(m))
      EXPECT_TRUE(check.passed()) << law_of(m).name << ' ' << m.value[3] << ": " << check.what << ": " << check.value;
}

TEST(BlockRubber, HasTheModuliOfItsParametersAtRest) {
  for (auto const& [m, modulus] :
       {std::pair{treloar(), 0.4225e6}, std::pair{four_terms(), mu}, std::pair{eight_chains(3), mu}}) {
    BlockLaw const law(m);
    EXPECT_NEAR(law.mu, modulus, 1e-5 * modulus);
    EXPECT_NEAR(law.kappa, kappa, 1e-5 * kappa);
    EXPECT_EQ(problem_of_block_law(m), "");
  }
}

TEST(BlockRubber, RefusesParametersThatDoNotGoTogether) {
  struct Wrong {
    MaterialParameters m;
    char const* words;
  };
  for (Wrong const& wrong :
       {Wrong{ogden({{"mu_1", mu}, {"alpha_1", -2}}), "sum of mu_i alpha_i"},
        Wrong{ogden({{"mu_1", mu}, {"alpha_1", 2}, {"mu_2", mu}, {"alpha_2", -2}}), "sum of mu_i alpha_i"},
        Wrong{ogden({{"mu_1", mu}, {"alpha_1", 2}, {"mu_3", mu}}), "alpha_3 = 0"},
        Wrong{ogden({{"mu_1", mu}, {"alpha_1", 2}, {"alpha_2", 3}}), "mu_2 = 0"},
        Wrong{viscoelastic({{"g_1", 0.6}, {"tau_1", 1}, {"g_2", 0.4}, {"tau_2", 2}}), "sum of g_i is 1"},
        Wrong{viscoelastic({{"g_1", 0.6}, {"tau_1", 1}, {"g_4", 0.1}}), "tau_4"}}) {
    std::string const problem = problem_of_block_law(wrong.m);
    EXPECT_NE(problem.find(wrong.words), std::string::npos) << problem;
  }
}

/// Isochoric uniaxial and equibiaxial stretch: differences of principal stresses are sum mu_i (l_1^alpha - l_3^alpha).
TEST(Ogden, HasTheUniaxialAndEquibiaxialStressOfItsFormula) {
  auto const m = treloar();
  for (double const stretch : {0.4, 0.99, 1.0001, 1.5, 3.0, 7.0})
    for (double const other : {1 / std::sqrt(stretch), stretch}) {
      double const third = 1 / (stretch * other);
      double expected = 0;
      for (int i = 0; i < 3; ++i)
        expected += m.value[2 + 2 * i] * (std::pow(stretch, m.value[3 + 2 * i]) - std::pow(third, m.value[3 + 2 * i]));
      auto const sigma = stress_at(m, stretches(stretch, other, third));
      EXPECT_NEAR(sigma(0, 0) - sigma(2, 2), expected, near(expected)) << stretch;
      EXPECT_NEAR(sigma(1, 1) - (other == stretch ? sigma(0, 0) : sigma(2, 2)), 0, near(expected)) << stretch;
      EXPECT_NEAR(trace(sigma), 0, near(expected)) << stretch;
    }
}

Mat<3> neo_hookean(double modulus, Mat<3> const& F) {
  double const J = determinant(F), shape = modulus / std::pow(J, 2.0 / 3);
  return shape * F + (kappa * (J - 1) - shape * contract(F, F) / (3 * J)) * cofactor(F);
}
std::vector<Mat<3>> gradients() {
  std::vector<Mat<3>> all{stretches(2, 2, 2), stretches(3, 1, 1), stretches(0.5, 0.5, 1), shear(1e-9), shear(4)};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(-0.3, 0.3);
  for (int k = 0; k < 20; ++k) {
    all.push_back(identity<3>());
    for (double& f : all.back().c) f += part(random);
  }
  return all;
}

TEST(Ogden, IsNeoHookeanForAnExponentOfTwo) {
  auto const m = ogden({{"mu_1", 0.4 * mu}, {"alpha_1", 2}, {"mu_2", 0.6 * mu}, {"alpha_2", 2}});
  for (auto const& F : gradients()) {
    Point point(m);
    auto const P = point.go(F), expected = neo_hookean(mu, F);
    double const J = determinant(F);
    double const energy = 0.5 * mu * (contract(F, F) / std::pow(J, 2.0 / 3) - 3) + 0.5 * kappa * (J - 1) * (J - 1);
    for (int c = 0; c < 9; ++c)
      EXPECT_NEAR(P.c[c], expected.c[c], 1e-12 * mu + 1e-6 * std::sqrt(contract(expected, expected)));
    EXPECT_NEAR(point.energy, energy, 1e-9 * mu + near(energy));
  }
}

/// sigma_12 = 2 W1 gamma with W1 = dW/dI of the five terms (Arruda, Boyce 1993), I = 3 + gamma^2.
TEST(ArrudaBoyce, HasTheShearStressOfItsFormula) {
  constexpr double limit = 1.8;
  constexpr double C[]{1.0 / 2, 1.0 / 20, 11.0 / 1050, 19.0 / 7000, 519.0 / 673750};
  auto const slope = [&](double I) {
    double sum = 0;
    for (int i = 1; i <= 5; ++i) sum += i * C[i - 1] * std::pow(limit, 2 - 2 * i) * std::pow(I, i - 1);
    return sum;
  };
  for (double const gamma : {1e-3, 0.3, 1.0, 2.5}) {
    double const expected = mu * gamma * slope(3 + gamma * gamma) / slope(3);
    EXPECT_NEAR(stress_at(eight_chains(limit), shear(gamma))(0, 1), expected, near(expected)) << gamma;
  }
}

TEST(Viscoelastic, AnswersAtOnceWithTheInstantaneousModulus) {
  for (auto const& F : gradients()) {
    auto const P = Point(four_terms()).go(F), expected = neo_hookean(mu, F);
    for (int c = 0; c < 9; ++c)
      EXPECT_NEAR(P.c[c], expected.c[c], 1e-12 * mu + 1e-6 * std::sqrt(contract(expected, expected)));
  }
}

/// After a step of strain the isochoric stress is G(t)/G(0) times the instantaneous one, at any size and in any steps.
TEST(Viscoelastic, RelaxesByItsPronySeries) {
  auto const m = four_terms();
  for (auto const& F : gradients())
    for (double const dt : {1e-5, 1e-3, 0.5}) {
      Point point(m);
      point.go(F);
      auto const pressure = neo_hookean(0, F), elastic = neo_hookean(mu, F) - pressure;
      for (int step = 1; step <= 20; ++step) {
        auto const off = point.go(F, dt) - pressure - relaxation(m, step * dt) * elastic;
        EXPECT_LE(std::sqrt(contract(off, off)), 1e-6 * std::sqrt(contract(elastic, elastic)) + 1e-9 * mu);
      }
    }
}

/// Small strain at a constant rate: sigma = rate int_0^t G(t - s) ds. The recurrence is exact for it at any step.
TEST(Viscoelastic, FollowsARampAtAnyStep) {
  auto const m = four_terms();
  for (int const steps : {1, 7, 100}) {
    constexpr double duration = 5e-3, gamma = 1e-5;
    Point point(m);
    Mat<3> P;
    for (int k = 1; k <= steps; ++k) P = point.go(shear(gamma * k / steps), duration / steps);
    double expected = 1;
    for (int i = 0; i < 4; ++i) {
      double const x = duration / m.value[4 + 2 * i];
      expected -= m.value[3 + 2 * i] * (1 + std::expm1(-x) / x);
    }
    expected *= mu * gamma;
    EXPECT_NEAR(P(0, 1), expected, near(expected)) << steps;
  }
}

/// Simple shear gamma = rate t of any size: sigma_12 = rate int_0^t G(t - s) (1 + gamma(s)^2 - 2/3 gamma(t) gamma(s))
/// ds, from S~_12 = mu gamma (3 + gamma^2)/3, S~_22 = -mu gamma^2/3 and sigma_12 = S_12 + gamma(t) S_22.
TEST(Viscoelastic, FollowsALargeRampLikeTheConvolution) {
  auto const m = four_terms();
  constexpr double duration = 5e-3, most = 2;
  constexpr int steps = 4000;
  Point point(m);
  Mat<3> P;
  double integral = 0;
  for (int k = 1; k <= steps; ++k) P = point.go(shear(most * k / steps), duration / steps);
  for (int k = 0; k <= steps; ++k) {  // Simpson's rule
    double const share = static_cast<double>(k) / steps, gamma = most * share;
    double const weight = (k == 0 || k == steps ? 1 : (k % 2 == 1 ? 4 : 2)) / (3.0 * steps);
    integral += weight * relaxation(m, duration * (1 - share)) * (1 + gamma * gamma - 2 * most * gamma / 3);
  }
  double const expected = mu * most * integral;
  auto const sigma = cauchy(P, shear(most));
  EXPECT_NEAR(sigma(0, 1), expected, near(expected));
  EXPECT_NEAR(trace(sigma), 0, near(expected)) << "the pressure is elastic, and J = 1";
}

/// G' = G(inf) + sum G_i x^2/(1 + x^2), G'' = sum G_i x/(1 + x^2), x = omega tau_i (Ferry, Viscoelastic Properties of
/// Polymers, 1980), from the last of many periods of a shear strain.
TEST(Viscoelastic, HasStorageAndLossModuliOfItsPronySeries) {
  auto const m = viscoelastic({{"g_1", 0.3}, {"tau_1", 1e-4}, {"g_2", 0.4}, {"tau_2", 1e-3}});
  for (double const omega : {3e2, 1e3, 2e4}) {
    constexpr int steps = 400;
    constexpr double gamma = 1e-4;
    int const periods = 2 + static_cast<int>(omega * 20e-3 / (2 * std::numbers::pi));
    Point point(m);
    double storage = 0, loss = 0;
    for (int k = 1; k <= periods * steps; ++k) {
      double const phase = 2 * std::numbers::pi * k / steps;
      double const sigma = point.go(shear(gamma * std::sin(phase)), 2 * std::numbers::pi / (omega * steps))(0, 1);
      if (k <= (periods - 1) * steps) continue;
      storage += 2 * sigma * std::sin(phase) / (gamma * steps);
      loss += 2 * sigma * std::cos(phase) / (gamma * steps);
    }
    double expected_storage = 0.3 * mu, expected_loss = 0;
    for (int i = 0; i < 2; ++i) {
      double const x = omega * m.value[4 + 2 * i], G = mu * m.value[3 + 2 * i];
      expected_storage += G * x * x / (1 + x * x);
      expected_loss += G * x / (1 + x * x);
    }
    EXPECT_NEAR(storage, expected_storage, 1e-3 * expected_storage) << omega;
    EXPECT_NEAR(loss, expected_loss, 1e-3 * expected_loss) << omega;
  }
}

/// Work of closed paths of large strain, from rest, at rates around those of the terms.
TEST(Viscoelastic, TakesEnergyInClosedPaths) {
  auto const m = four_terms();
  for (double const duration : {1e-5, 1e-3, 1e-1})
    for (auto const& end : gradients()) {
      constexpr int steps = 400;
      Point point(m);
      Mat<3> F = identity<3>(), P = point.go(F);
      double work = 0, out = 0;
      for (int k = 1; k <= steps; ++k) {
        double const share = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * k / steps);
        Mat<3> const next = identity<3>() + share * (end - identity<3>());
        Mat<3> const stress = point.go(next, duration / steps);
        work += 0.5 * contract(P + stress, next - F);
        out = std::max(out, work);
        F = next;
        P = stress;
      }
      constexpr double truncation = 1e-4;  // of the trapezoidal rule
      EXPECT_GE(work, -truncation * out) << duration;
    }
}

}  // namespace
}  // namespace piola::testing
