// SPDX-License-Identifier: Apache-2.0
#include "piola/math/table_function.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck/gtest.h>
#include <set>

namespace piola {
namespace {

using Outside = TableFunction::Outside;
using Gives = TableFunction::Gives;
constexpr auto smooth = TableFunction::Interpolation::smooth;

std::vector<double> const x{0, 1, 3, 4, 7, 8}, y{0, 2, 3, 3, -1, 0.5};

// scipy.interpolate.PchipInterpolator of SciPy 1.10.1 on the same table.
TEST(TableFunction, SmoothIsThePchipOfScipy) {
  std::vector<double> const at{0.25, 0.5, 2, 2.75, 3.5, 5, 6.5, 7.25, 7.9};
  std::vector<double> const value{0.6238839285714285, 1.2053571428571428,  2.7142857142857144, 2.98046875,         3.0,
                                  1.962962962962963,  -0.7037037037037024, -0.869140625,       0.27912500000000073};
  std::vector<double> const slope{
      2.4508928571428568,  2.1607142857142856,  0.5357142857142857, 0.15401785714285715, 0.0,
      -1.7777777777777777, -1.1111111111111107, 0.9973958333333333, 2.201250000000001};
  TableFunction const f(x, y, {.interpolation = smooth}), df(x, y, {.interpolation = smooth, .gives = Gives::slope});
  for (std::size_t k = 0; k < at.size(); ++k) {
    EXPECT_NEAR(f(at[k]), value[k], 1e-14) << at[k];
    EXPECT_NEAR(df(at[k]), slope[k], 1e-14) << at[k];
  }
  EXPECT_DOUBLE_EQ(monotone_slopes(x, y).front(), 2.5);
  EXPECT_DOUBLE_EQ(monotone_slopes(x, y).back(), 2.2083333333333335);
}

TEST(TableFunction, LinearIsStraightBetweenRowsAndExactAtThem) {
  TableFunction const f(x, y, {}), df(x, y, {.gives = Gives::slope});
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_EQ(f(x[k]), y[k]);
  EXPECT_DOUBLE_EQ(f(2), 2.5);
  EXPECT_DOUBLE_EQ(f(5.5), 1);
  EXPECT_DOUBLE_EQ(df(5.5), -4.0 / 3);
  EXPECT_DOUBLE_EQ(df(1), 0.5) << "the slope to the right";
  EXPECT_DOUBLE_EQ(df(8), 1.5);
}

TEST(TableFunction, EndsHoldVanishOrAreNoNumber) {
  TableFunction const holds(x, y, {}), ends(x, y, {.before = Outside::zero, .after = Outside::error});
  EXPECT_EQ(holds(-1), 0);
  EXPECT_EQ(holds(9), 0.5);
  EXPECT_EQ(TableFunction({1, 2}, {3, 4}, {.before = Outside::zero})(0.5), 0);
  EXPECT_EQ(ends(8), 0.5) << "the last row is inside";
  EXPECT_TRUE(std::isnan(ends(std::nextafter(8, 9))));
  EXPECT_TRUE(std::isnan(holds(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_EQ(TableFunction(x, y, {.gives = Gives::slope})(9), 0) << "that of a held value";
}

RC_GTEST_PROP(TableFunction, NeverOvershootsItsRows, (std::vector<double> heights, std::set<std::uint16_t> places)) {
  std::vector<double> at(places.begin(), places.end());
  std::size_t const n = std::min(at.size(), heights.size());
  RC_PRE(n >= 2);
  at.resize(n);
  for (double& h : heights) h = std::isfinite(h) ? std::fmod(h, 1e3) : 1;
  heights.resize(n);
  TableFunction const f(at, heights, {.interpolation = smooth});
  for (std::size_t k = 0; k + 1 < n; ++k)
    for (double const s : {0.0, 0.01, 0.3, 0.5, 0.77, 0.99, 1.0}) {
      double const value = f(at[k] + s * (at[k + 1] - at[k]));
      RC_ASSERT(value >= std::min(heights[k], heights[k + 1]) - 1e-10);
      RC_ASSERT(value <= std::max(heights[k], heights[k + 1]) + 1e-10);
    }
}

}  // namespace
}  // namespace piola
