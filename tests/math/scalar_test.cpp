// SPDX-License-Identifier: Apache-2.0
#include "piola/math/scalar.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace piola {
namespace {

constexpr double ulp = std::numeric_limits<double>::epsilon();

TEST(PowerMinusThird, IsRightToAFewUnitsInTheLastPlaceOverTwelveDecades) {
  for (double exponent = -6; exponent <= 6; exponent += 1e-3) {
    double const a = std::pow(10, exponent), y = power_minus_third(a);
    EXPECT_NEAR(a * y * y * y, 1, 24 * ulp) << a;  // 3 times the error of y, about 4 ulp, and the product's own
  }
}

TEST(PowerMinusThird, IsOneAtOneExactly) { EXPECT_EQ(power_minus_third(1.0), 1.0); }

TEST(PowerMinusThird, HasNoStepWhereTheMethodChanges) {
  for (double const edge : {0.25, 4.0}) {
    double const below = power_minus_third(edge * (1 - ulp)), above = power_minus_third(edge * (1 + ulp));
    EXPECT_NEAR(below / above, 1, 8 * ulp);
    EXPECT_NEAR(power_minus_third(edge), 1 / std::cbrt(edge), 8 * ulp);
  }
}

TEST(PowerMinusThird, StaysFiniteFarFromOne) {
  EXPECT_DOUBLE_EQ(power_minus_third(1e-300), 1e100);
  EXPECT_DOUBLE_EQ(power_minus_third(1e300), 1e-100);
}

TEST(Logarithm, IsThatOfTheLibraryToAFewUnitsInTheLastPlaceOverTwelveDecades) {
  for (double exponent = -6; exponent <= 6; exponent += 1e-3) {
    double const a = std::pow(10, exponent), y = std::log(a);
    EXPECT_NEAR(logarithm(a), y, 4 * ulp * std::fabs(y)) << a;
  }
}

TEST(Logarithm, KeepsItsDigitsNearOne) {
  EXPECT_EQ(logarithm(1.0), 0.0);
  for (double const e : {1e-3, 1e-6, 1e-9, 1e-12, ulp})
    for (double const a : {1 - e, 1 + e}) EXPECT_NEAR(logarithm(a), std::log(a), 4 * ulp * std::fabs(std::log(a))) << a;
}

TEST(Logarithm, HasNoStepWhereTheMethodChanges) {
  for (double const edge : {0.25, 0.35, 0.7, 1.42, 2.84, 4.0})
    for (double const a : {edge * (1 - 2 * ulp), edge, edge * (1 + 2 * ulp)})
      EXPECT_NEAR(logarithm(a), std::log(a), 4 * ulp * std::fabs(std::log(a))) << a;
}

TEST(Logarithm, StaysFiniteFarFromOne) {
  EXPECT_DOUBLE_EQ(logarithm(1e-300), std::log(1e-300));
  EXPECT_DOUBLE_EQ(logarithm(1e300), std::log(1e300));
}

}  // namespace
}  // namespace piola
