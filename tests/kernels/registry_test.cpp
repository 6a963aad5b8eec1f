// SPDX-License-Identifier: Apache-2.0
#include "piola/kernels/registry.hpp"
#include "piola/kernels/cubic_spline.hpp"
#include "piola/kernels/quartic_spline.hpp"
#include "piola/kernels/quintic_spline.hpp"
#include "piola/kernels/wendland_c2.hpp"
#include "piola/kernels/wendland_c4.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <set>
#include <string>

namespace piola {
namespace {

/// The battery that every registered kernel goes through.
class KernelBattery : public ::testing::TestWithParam<Kernel> {};

constexpr int dimensions[] = {1, 2, 3};

/// Integral of f over [0, support] by Gauss's rule of two points in 2000 panels: exact for cubics on each panel, error
/// far below 1e-11 for smooth pieces that meet at multiples of a panel.
template <class F>
double integral(Kernel const& kernel, F const& f) {
  int const panels = 2000;
  double const width = kernel.support / panels, x = 0.5 / std::sqrt(3.0);
  double sum = 0;
  for (int k = 0; k < panels; ++k) sum += 0.5 * width * (f(width * (k + 0.5 - x)) + f(width * (k + 0.5 + x)));
  return sum;
}

TEST_P(KernelBattery, IntegratesToOneInEveryDimension) {
  Kernel const& k = GetParam();
  double const surface[] = {2, 2 * std::numbers::pi, 4 * std::numbers::pi};
  for (int D = 1; D <= 3; ++D) {
    double const shell = integral(k, [&](double q) { return k.w(D, q) * std::pow(q, D - 1); });
    EXPECT_NEAR(k.sigma(D) * surface[D - 1] * shell, 1, 1e-11) << D;
  }
}

/// -1/D sum r.grad W = 1 is what makes M_a the identity far from boundaries.
TEST_P(KernelBattery, GradientHasTheFirstMomentThatDifferentiatesLinearFields) {
  Kernel const& k = GetParam();
  double const surface[] = {2, 2 * std::numbers::pi, 4 * std::numbers::pi};
  for (int D = 1; D <= 3; ++D) {
    double const shell = integral(k, [&](double q) { return -k.dw(D, q) * std::pow(q, D); });
    EXPECT_NEAR(k.sigma(D) * surface[D - 1] * shell / D, 1, 1e-11) << D;
  }
}

TEST_P(KernelBattery, DerivativeIsThatOfTheKernel) {
  Kernel const& k = GetParam();
  double const step = 1e-5;
  for (int const D : dimensions)
    for (double q = 0.01; q < k.support + 0.5; q += 0.0137)  // error: step^2 w''' and round-off / step
      EXPECT_NEAR((k.w(D, q + step) - k.w(D, q - step)) / (2 * step), k.dw(D, q), 1e-9 * k.w(D, 0)) << q;
}

TEST_P(KernelBattery, FallsFromTheCentreToZeroAtTheSupport) {
  Kernel const& k = GetParam();
  for (int const D : dimensions) {
    EXPECT_GT(k.w(D, 0), 0);
    EXPECT_EQ(k.dw(D, 0), 0);  // zero first moment needs evenness; without this the kernel has a peak
    for (double q = 0.01; q < k.support - 0.01; q += 0.01) {
      EXPECT_GT(k.w(D, q), 0) << q;
      EXPECT_LT(k.dw(D, q), 0) << q;
    }
    EXPECT_NEAR(k.w(D, k.support), 0, 1e-15);
    EXPECT_NEAR(k.dw(D, k.support), 0, 1e-15);
    EXPECT_EQ(k.w(D, k.support + 0.1), 0);
    EXPECT_EQ(k.dw(D, k.support + 0.1), 0);
  }
}

/// Polynomial pieces meet at multiples of 1/2. Of a kernel's derivatives up to the second none has a step there: what
/// they change by over a small distance is in proportion to it.
TEST_P(KernelBattery, HasTwoContinuousDerivatives) {
  Kernel const& k = GetParam();
  double const near = 1e-6;
  for (int const D : dimensions)
    for (double knot = 0.5; knot < k.support + 0.1; knot += 0.5) {
      double const before = knot - near, after = knot + near, top = k.w(D, 0);
      EXPECT_NEAR(k.w(D, before), k.w(D, after), 4 * near * top) << knot;
      EXPECT_NEAR(k.dw(D, before), k.dw(D, after), 10 * near * top) << knot;
      double const left = (k.dw(D, knot) - k.dw(D, before)) / near, right = (k.dw(D, after) - k.dw(D, knot)) / near;
      EXPECT_NEAR(left, right, 20 * near * top) << knot;
    }
}

TEST_P(KernelBattery, FirstMomentVanishes) {
  Kernel const& k = GetParam();
  // In one dimension, as a sum over both sides: W depends on |r| alone.
  double first = 0, size = 0;
  for (int i = -400; i <= 400; ++i) {
    double const r = i * k.support / 400;
    first += r * k.w(1, std::fabs(r));
    size += std::fabs(r) * k.w(1, std::fabs(r));
  }
  EXPECT_GT(size, 0);
  EXPECT_LT(std::fabs(first), 1e-12 * size);
}

INSTANTIATE_TEST_SUITE_P(All, KernelBattery, ::testing::ValuesIn(kernels().begin(), kernels().end()),
                         [](auto const& p) { return std::string(p.param.name); });

TEST(Kernels, AreFoundByTheirNames) {
  std::set<std::string_view> names;
  for (auto const& kernel : kernels()) {
    EXPECT_TRUE(names.insert(kernel.name).second) << kernel.name;
    ASSERT_NE(find_kernel(kernel.name), nullptr);
    EXPECT_EQ(find_kernel(kernel.name)->w(3, 0.5), kernel.w(3, 0.5));
    EXPECT_FALSE(kernel.about.empty());
  }
  EXPECT_EQ(find_kernel("no_such_kernel"), nullptr);
}

TEST(CubicSpline, HasTheValuesOfItsFormula) {
  // w(0) = 2^3/4 - 1 = 1, w(1) = 1/4, w(1/2) = 27/32 - 1/8 = 23/32, w(3/2) = 1/32
  EXPECT_DOUBLE_EQ(CubicSpline::w(0.0), 1);
  EXPECT_DOUBLE_EQ(CubicSpline::w(1.0), 0.25);
  EXPECT_DOUBLE_EQ(CubicSpline::w(0.5), 23.0 / 32);
  EXPECT_DOUBLE_EQ(CubicSpline::w(1.5), 1.0 / 32);
  EXPECT_DOUBLE_EQ(CubicSpline::dw(1.0), -0.75);
  EXPECT_DOUBLE_EQ(CubicSpline::sigma(3), 1 / std::numbers::pi);
}

TEST(QuarticSpline, HasTheValuesOfItsFormula) {
  // w(0) = (625 - 405 + 10) / 16, w(1/2) = 2^4 - 5 = 11, w(3/2) = 1; dw(3/2) = -4
  EXPECT_DOUBLE_EQ(QuarticSpline::w(0.0), 230.0 / 16);
  EXPECT_DOUBLE_EQ(QuarticSpline::w(0.5), 11);
  EXPECT_DOUBLE_EQ(QuarticSpline::w(1.5), 1);
  EXPECT_DOUBLE_EQ(QuarticSpline::dw(1.5), -4);
}

TEST(QuinticSpline, HasTheValuesOfItsFormula) {
  // w(0) = 243 - 192 + 15, w(1) = 32 - 6, w(2) = 1; dw(1) = -5 (16 - 6)
  EXPECT_DOUBLE_EQ(QuinticSpline::w(0.0), 66);
  EXPECT_DOUBLE_EQ(QuinticSpline::w(1.0), 26);
  EXPECT_DOUBLE_EQ(QuinticSpline::w(2.0), 1);
  EXPECT_DOUBLE_EQ(QuinticSpline::dw(1.0), -50);
}

TEST(WendlandC2, HasTheValuesOfItsFormula) {
  // s = 1/2: (1/16) 3 in 2D and 3D, (1/8) (5/2) in 1D
  EXPECT_DOUBLE_EQ(WendlandC2::w(3, 1.0), 3.0 / 16);
  EXPECT_DOUBLE_EQ(WendlandC2::w(2, 1.0), 3.0 / 16);
  EXPECT_DOUBLE_EQ(WendlandC2::w(1, 1.0), 5.0 / 16);
  EXPECT_DOUBLE_EQ(WendlandC2::dw(3, 1.0), -5.0 / 8);
}

TEST(WendlandC4, HasTheValuesOfItsFormula) {
  // s = 1/2: (1/64) (1 + 3 + 35/12) in 2D and 3D, (1/32) (1 + 5/2 + 2) in 1D
  EXPECT_DOUBLE_EQ(WendlandC4::w(3, 1.0), 83.0 / 768);
  EXPECT_DOUBLE_EQ(WendlandC4::w(1, 1.0), 11.0 / 64);
}

}  // namespace
}  // namespace piola
