// SPDX-License-Identifier: Apache-2.0
// Packs of lanes against one double, for what is not a number. This file is a machine of its own; that the machines of
// the program do the same is tested through their reductions (formulations/jst_sph/machines_test.cpp).
#undef PIOLA_BACKEND
#undef PIOLA_BACKEND_IS_HOST
#define PIOLA_BACKEND test_extremes
#define PIOLA_BACKEND_IS_NATIVE 1
#include "piola/math/lanes.hpp"
#include <array>
#include <gtest/gtest.h>
#include <limits>

namespace piola::inline PIOLA_BACKEND {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
constexpr std::array values{nan, -infinity, -2.0, 0.0, 3.0, infinity};

TEST(Extremes, AreNotANumberIfOneOfTheTwoIsNone) {
  for (double const value : values) {
    EXPECT_TRUE(std::isnan(minimum(nan, value)) && std::isnan(minimum(value, nan))) << value;
    EXPECT_TRUE(std::isnan(maximum(nan, value)) && std::isnan(maximum(value, nan))) << value;
  }
}

TEST(Extremes, OfNumbersAreTheLessAndTheGreater) {
  EXPECT_EQ(minimum(-2.0, 3.0), -2);
  EXPECT_EQ(minimum(3.0, -2.0), -2);
  EXPECT_EQ(maximum(-2.0, 3.0), 3);
  EXPECT_EQ(maximum(infinity, 3.0), infinity);
}

/// Whatever stands in the lanes beside, and with a bound that is known when this is compiled.
TEST(Extremes, OfPacksAreThoseOfEachLane) {
  for (double const a : values)
    for (double const b : values) {
      Lanes first(1.0), second(0.5);
      first[lane_count - 1] = a;
      second[lane_count - 1] = b;
      auto const expect_equal = [&](Lanes const& many, double one) {
        double const last = lane(many, lane_count - 1);
        EXPECT_TRUE(last == one || (std::isnan(last) && std::isnan(one))) << a << " " << b << " " << last;
      };
      expect_equal(minimum(first, second), minimum(a, b));
      expect_equal(maximum(first, second), maximum(a, b));
      expect_equal(maximum(first, Lanes(0.0)), maximum(a, 0.0));
      expect_equal(minimum(first, Lanes(0.0)), minimum(a, 0.0));
      if (lane_count == 1) continue;
      EXPECT_EQ(lane(maximum(first, second), 0), 1);
      EXPECT_EQ(lane(minimum(first, second), 0), 0.5);
    }
}

TEST(Select, TakesEachLaneByItsOwnCondition) {
  Lanes value(-1.0);
  value[lane_count - 1] = 1;
  Lanes const chosen = select(value > 0.0, Lanes(2.0), Lanes(3.0));
  EXPECT_EQ(lane(chosen, lane_count - 1), 2);
  if (lane_count > 1) {
    EXPECT_EQ(lane(chosen, 0), 3);
  }
}

}  // namespace
}  // namespace piola::inline PIOLA_BACKEND
