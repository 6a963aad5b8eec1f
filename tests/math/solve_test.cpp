// SPDX-License-Identifier: Apache-2.0
#include "piola/math/solve.hpp"
#include "math/random.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

TEST(SolveInPlace, SolvesASystemThatNeedsExchangesOfRows) {
  double A[9] = {0, 2, 1, 1, -2, -3, -1, 1, 2};
  double b[3] = {-8, 0, 3};
  EXPECT_GT(solve_in_place<3>(A, b), 0);
  // -x + y + 2z = 3, x - 2y - 3z = 0, 2y + z = -8 has the solution (-4, -5, 2).
  EXPECT_NEAR(b[0], -4, 1e-14);
  EXPECT_NEAR(b[1], -5, 1e-14);
  EXPECT_NEAR(b[2], 2, 1e-14);
}

TEST(SolveInPlace, LeavesASmallResidualForRandomSystems) {
  testing::Random random(1);
  for (int k = 0; k < 1000; ++k) {
    double A[16], b[4], kept_A[16], kept_b[4];
    for (int i = 0; i < 16; ++i) kept_A[i] = A[i] = random.in(-1, 1);
    for (int i = 0; i < 4; ++i) kept_b[i] = b[i] = random.in(-1, 1);
    double const ratio = solve_in_place<4>(A, b);
    for (int i = 0; i < 4; ++i) {
      double r = -kept_b[i], scale = 1;
      for (int j = 0; j < 4; ++j) {
        r += kept_A[4 * i + j] * b[j];
        scale += std::fabs(b[j]);
      }
      EXPECT_LT(std::fabs(r), 1e-14 * scale);  // elimination with pivoting is backward stable
    }
    EXPECT_GT(ratio, 0);
    EXPECT_LE(ratio, 1);
  }
}

TEST(SolveInPlace, ReportsTheRatioOfPivots) {
  double A[4] = {1e-3, 0, 0, 10}, b[2] = {1, 1};
  EXPECT_DOUBLE_EQ(solve_in_place<2>(A, b), 1e-4);
  EXPECT_DOUBLE_EQ(b[0], 1000);
  EXPECT_DOUBLE_EQ(b[1], 0.1);
}

TEST(SolveInPlace, ReportsZeroForASingularSystem) {
  double A[4] = {1, 2, 2, 4}, b[2] = {1, 2};
  EXPECT_EQ(solve_in_place<2>(A, b), 0);
  double zero[1] = {0}, one[1] = {1};
  EXPECT_EQ(solve_in_place<1>(zero, one), 0);
}

TEST(SolveInPlace, ReportsZeroRatherThanNumbersForNan) {
  double A[4] = {std::nan(""), 1, 1, 1}, b[2] = {1, 1};
  EXPECT_FALSE(solve_in_place<2>(A, b) > 0);
}

}  // namespace
}  // namespace piola
