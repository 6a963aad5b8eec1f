// SPDX-License-Identifier: Apache-2.0
// Values and gradients that follow from kernel sums over sources around a target.
#include "piola/formulations/taylor_sph/sums.hpp"
#include "math/random.hpp"
#include <gtest/gtest.h>
#include <vector>

namespace piola::taylor_sph {
namespace {

using testing::Random;

template <int D>
struct Source {
  Vec<D> x;
  double volume;
  double f[Record<D>::fields];
};

template <int D, class Kernel = CubicSpline>
Estimate<D, double> estimate_from(std::vector<Source<D>> const& sources, Vec<D> const& target, double h,
                                  GradientForm form) {
  KernelSums<D, Lanes> sums{};
  for (auto const& s : sources) {
    Lanes record[Record<D>::values];
    for (int c = 0; c < D; ++c) record[c] = s.x[c];
    record[Record<D>::volume] = s.volume;
    for (int c = 0; c < Record<D>::fields; ++c) record[Record<D>::v + c] = s.f[c];
    add_source<D, Kernel>(record, target, Lanes(1 / h), sums);
  }
  return estimate<D>(sums, form);
}

/// Field c is  c + (1 + c) x - 2 y + 0.5 c z.
template <int D>
double slope(int c, int a) {
  double const all[] = {1.0 + c, -2.0, 0.5 * c};
  return all[a];
}
template <int D>
double linear(int c, Vec<D> const& x) {
  double sum = c;
  for (int a = 0; a < D; ++a) sum += slope<D>(c, a) * x[a];
  return sum;
}
template <int D>
Source<D> source_at(Vec<D> const& x, double volume) {
  Source<D> s{x, volume, {}};
  for (int c = 0; c < Record<D>::fields; ++c) s.f[c] = linear<D>(c, x);
  return s;
}

/// Sources of all sizes on one side of the target, all within the support.
template <int D>
std::vector<Source<D>> lopsided(Random& random, Vec<D> const& target) {
  std::vector<Source<D>> r;
  for (int k = 0; k < 3 * D + 2; ++k) {
    Vec<D> x = target;
    for (int a = 0; a < D; ++a) x[a] += random.in(-0.3, 0.8);
    r.push_back(source_at<D>(x, random.in(0.5, 2)));
  }
  return r;
}

template <int D, class Kernel>
void expect_linear_exact(std::uint32_t seed) {
  Random random(seed);
  double printed_error = 0;
  for (int trial = 0; trial < 50; ++trial) {
    Vec<D> target;
    for (int a = 0; a < D; ++a) target[a] = random.in(-2, 2);
    auto const sources = lopsided<D>(random, target);
    auto const e = estimate_from<D, Kernel>(sources, target, 1, GradientForm::linear_exact);
    auto const p = estimate_from<D, Kernel>(sources, target, 1, GradientForm::as_published);
    for (int c = 0; c < Record<D>::fields; ++c) {
      EXPECT_NEAR(e.f[c], linear<D>(c, target), 1e-11);
      for (int a = 0; a < D; ++a) {
        EXPECT_NEAR(e.gradient[c][a], (slope<D>(c, a)), 1e-11);
        printed_error = std::fmax(printed_error, std::fabs(p.gradient[c][a] - slope<D>(c, a)));
      }
    }
  }
  EXPECT_GT(printed_error, 0.1) << "the printed form is not linear-exact on one side";
}

TEST(Estimate, OfLinearFieldsIsExactOnAnySet) {
  expect_linear_exact<1, CubicSpline>(1);
  expect_linear_exact<2, CubicSpline>(2);
  expect_linear_exact<3, CubicSpline>(3);
  expect_linear_exact<1, WendlandC2>(4);
  expect_linear_exact<2, WendlandC2>(5);
  expect_linear_exact<3, WendlandC2>(6);
}

/// A constant is exact in both forms.
TEST(Estimate, OfAConstantHasNoGradient) {
  Random random(7);
  Vec<2> const target{{0.3, -0.4}};
  auto sources = lopsided<2>(random, target);
  for (auto& s : sources)
    for (double& f : s.f) f = 3;
  for (auto const form : {GradientForm::linear_exact, GradientForm::as_published}) {
    auto const e = estimate_from<2>(sources, target, 1, form);
    for (int c = 0; c < Record<2>::fields; ++c) {
      EXPECT_NEAR(e.f[c], 3, 1e-13);
      for (int a = 0; a < 2; ++a) EXPECT_NEAR(e.gradient[c][a], 0, 1e-12);
    }
  }
}

TEST(Estimate, OfBothFormsIsTheSameWhereTheCentroidIsTheTarget) {
  std::vector<Source<2>> sources;
  Random random(8);
  for (double const x : {-0.5, 0.5})
    for (double const y : {-0.5, 0.5}) {
      auto s = source_at<2>({{x, y}}, 1);
      for (double& f : s.f) f = random.in(-1, 1);
      sources.push_back(s);
    }
  auto const e = estimate_from<2>(sources, {}, 0.6, GradientForm::linear_exact);
  auto const p = estimate_from<2>(sources, {}, 0.6, GradientForm::as_published);
  for (int c = 0; c < Record<2>::fields; ++c) {
    EXPECT_NEAR(e.f[c], p.f[c], 1e-15);
    double mean = 0, along_x = 0;
    for (auto const& s : sources) {
      mean += s.f[c] / 4;
      along_x += s.x[0] * s.f[c];  // (right - left) / 2
    }
    EXPECT_NEAR(e.f[c], mean, 1e-15);
    EXPECT_NEAR(e.gradient[c][0], along_x, 1e-14);
    for (int a = 0; a < 2; ++a) EXPECT_NEAR(e.gradient[c][a], p.gradient[c][a], 1e-14);
  }
}

/// Weights of four sources at +-1/2 and +-3/2 spacings: of values, and of gradients (f+ - f-) / spacing.
struct Weights {
  double near, far, near_slope, far_slope;
};
Weights weights_of_a_row(double h) {
  double const x[] = {-1.5, -0.5, 0.5, 1.5};
  auto const response = [&](int k) {
    std::vector<Source<1>> sources;
    for (int s = 0; s < 4; ++s) sources.push_back({{{x[s]}}, 1, {s == k ? 1.0 : 0.0, 0}});
    return estimate_from<1>(sources, {}, h, GradientForm::linear_exact);
  };
  auto const near = response(2), far = response(3);
  EXPECT_NEAR(response(1).gradient[0][0], -near.gradient[0][0], 1e-15);
  return {near.f[0], far.f[0], near.gradient[0][0], far.gradient[0][0]};
}

/// Section 4.1 of the paper: smoothing lengths of 1.2, 1.8 and 2.2 half spacings. Weights from the printed kernel (16).
TEST(Estimate, InARowHasTheWeightsOfTheKernel) {
  Weights const two = weights_of_a_row(0.6);
  EXPECT_NEAR(two.near, 0.5, 1e-15);
  EXPECT_EQ(two.far, 0);
  EXPECT_NEAR(two.near_slope, 1, 1e-14);
  Weights const four = weights_of_a_row(0.9);
  EXPECT_NEAR(four.near, 0.49314, 1e-5);
  EXPECT_NEAR(four.far, 0.00686, 1e-5);
  EXPECT_NEAR(four.near_slope, 0.79545, 1e-5);
  EXPECT_NEAR(four.far_slope, 0.06818, 1e-5);
  Weights const wide = weights_of_a_row(1.1);
  EXPECT_NEAR(wide.near, 0.46095, 1e-5);
  EXPECT_NEAR(wide.far, 0.03905, 1e-5);
  EXPECT_NEAR(wide.near_slope, 0.49657, 1e-5);
  EXPECT_NEAR(wide.far_slope, 0.16781, 1e-5);
}

TEST(Estimate, DoesNotSeeSourcesThatOnlyFillALane) {
  Random random(9);
  Vec<3> const target{{0.1, 0.2, 0.3}};
  auto sources = lopsided<3>(random, target);
  auto const before = estimate_from<3>(sources, target, 1, GradientForm::linear_exact);
  sources.push_back({{{1e20, 1e20, 1e20}}, 0, {}});
  auto const after = estimate_from<3>(sources, target, 1, GradientForm::linear_exact);
  for (int c = 0; c < Record<3>::fields; ++c) {
    EXPECT_EQ(before.f[c], after.f[c]);
    for (int a = 0; a < 3; ++a) EXPECT_EQ(before.gradient[c][a], after.gradient[c][a]);
  }
}

}  // namespace
}  // namespace piola::taylor_sph
