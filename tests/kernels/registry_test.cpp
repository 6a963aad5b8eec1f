// SPDX-License-Identifier: Apache-2.0
#include "piola/kernels/registry.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <set>
#include <string>

namespace piola {
namespace {

/// The battery that every registered kernel goes through.
class KernelBattery : public ::testing::TestWithParam<Kernel> {};

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
    double const shell = integral(k, [&](double q) { return k.w(q) * std::pow(q, D - 1); });
    EXPECT_NEAR(k.sigma(D) * surface[D - 1] * shell, 1, 1e-11) << D;
  }
}

/// -1/D sum r.grad W = 1 is what makes M_a the identity far from boundaries.
TEST_P(KernelBattery, GradientHasTheFirstMomentThatDifferentiatesLinearFields) {
  Kernel const& k = GetParam();
  double const surface[] = {2, 2 * std::numbers::pi, 4 * std::numbers::pi};
  for (int D = 1; D <= 3; ++D) {
    double const shell = integral(k, [&](double q) { return -k.dw(q) * std::pow(q, D); });
    EXPECT_NEAR(k.sigma(D) * surface[D - 1] * shell / D, 1, 1e-11) << D;
  }
}

TEST_P(KernelBattery, DerivativeIsThatOfTheKernel) {
  Kernel const& k = GetParam();
  double const step = 1e-5;
  for (double q = 0.01; q < k.support + 0.5; q += 0.0137)
    EXPECT_NEAR((k.w(q + step) - k.w(q - step)) / (2 * step), k.dw(q), 1e-9) << q;  // step^2 w''' and round-off / step
}

TEST_P(KernelBattery, FallsFromTheCentreToZeroAtTheSupport) {
  Kernel const& k = GetParam();
  EXPECT_GT(k.w(0), 0);
  EXPECT_EQ(k.dw(0), 0);  // zero first moment needs evenness; without this the kernel has a peak
  for (double q = 0.01; q < k.support - 0.01; q += 0.01) {
    EXPECT_GT(k.w(q), 0) << q;
    EXPECT_LT(k.dw(q), 0) << q;
  }
  EXPECT_NEAR(k.w(k.support), 0, 1e-15);
  EXPECT_NEAR(k.dw(k.support), 0, 1e-15);
  EXPECT_EQ(k.w(k.support + 0.1), 0);
  EXPECT_EQ(k.dw(k.support + 0.1), 0);
}

TEST_P(KernelBattery, FirstMomentVanishes) {
  Kernel const& k = GetParam();
  // In one dimension, as a sum over both sides: W depends on |r| alone.
  double first = 0, size = 0;
  for (int i = -400; i <= 400; ++i) {
    double const r = i * k.support / 400;
    first += r * k.w(std::fabs(r));
    size += std::fabs(r) * k.w(std::fabs(r));
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
    EXPECT_EQ(find_kernel(kernel.name)->w(0.5), kernel.w(0.5));
    EXPECT_FALSE(kernel.about.empty());
  }
  EXPECT_EQ(find_kernel("no_such_kernel"), nullptr);
}

TEST(CubicSpline, HasTheValuesOfItsFormula) {
  // w(0) = 2^3/4 - 1 = 1, w(1) = 1/4, w(1/2) = 27/32 - 1/8 = 23/32, w(3/2) = 1/32
  EXPECT_DOUBLE_EQ(CubicSpline::w(0), 1);
  EXPECT_DOUBLE_EQ(CubicSpline::w(1), 0.25);
  EXPECT_DOUBLE_EQ(CubicSpline::w(0.5), 23.0 / 32);
  EXPECT_DOUBLE_EQ(CubicSpline::w(1.5), 1.0 / 32);
  EXPECT_DOUBLE_EQ(CubicSpline::dw(1), -0.75);
  EXPECT_DOUBLE_EQ(CubicSpline::sigma(3), 1 / std::numbers::pi);
}

}  // namespace
}  // namespace piola
