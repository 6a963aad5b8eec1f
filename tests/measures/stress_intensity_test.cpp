// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/stress_intensity.hpp"
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace piola {
namespace {

double singular(double K, double r) { return K / std::sqrt(2 * std::numbers::pi * r); }

TEST(StressIntensity, IsThatOfASingularField) {
  std::array const r{0.2, 0.3, 0.5};
  std::array const stress{singular(7e6, 0.2), singular(7e6, 0.3), singular(7e6, 0.5)};
  EXPECT_NEAR(stress_intensity(r, stress), 7e6, 1e-8);
}

// The next term of the expansion, of order sqrt(r), adds what is linear in r to K(r): the fit removes it exactly.
TEST(StressIntensity, TheNextTermOfTheFieldDropsOut) {
  std::array const r{0.2, 0.3, 0.5, 0.9};
  std::vector<double> stress;
  for (double const x : r) stress.push_back(singular(7e6, x) + 3e5 * std::sqrt(x));
  EXPECT_NEAR(stress_intensity(r, stress), 7e6, 1e-7);
}

TEST(StressIntensity, FitsByLeastSquares) {
  // K(r) of 1, 4, 4 at r = 1, 2, 3: the line 0 + 1.5 r.
  std::array const r{1.0, 2.0, 3.0};
  std::array const stress{singular(1, 1), singular(4, 2), singular(4, 3)};
  EXPECT_NEAR(stress_intensity(r, stress), 0, 1e-14);
}

TEST(StressIntensity, OneDistanceGivesTheMean) {
  EXPECT_DOUBLE_EQ(stress_intensity(std::array{0.5}, std::array{singular(3, 0.5)}), 3);
  EXPECT_DOUBLE_EQ(stress_intensity(std::array{0.3, 0.3}, std::array{singular(3, 0.3), singular(5, 0.3)}), 4);
}

}  // namespace
}  // namespace piola
