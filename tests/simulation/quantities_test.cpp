// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/quantities.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace piola {
namespace {

using Take = QuantitySpec::Take;

/// -2 sin(5 t) up to t = 1: a negative peak at pi/10, a positive one at 3 pi/10.
HistoryTable table() {
  HistoryTable t{{{"time", "s"}, {"y", "Pa"}}, {}};
  for (int k = 0; k <= 1000; ++k) {
    double const time = 0.001 * k;
    t.rows.push_back({time, -2 * std::sin(5 * time)});
  }
  return t;
}

double value(Take take, double threshold = 0, std::string const& unit = "1") {
  QuantitySpec spec{.name = "q",
                    .column = "y",
                    .take = take,
                    .threshold = threshold,
                    .time = 0.1234567,
                    .reference = Expression("0-2*sin(5*t)+0.5"),
                    .unit = unit};
  std::string why;
  auto const q = measure(spec, table(), why);
  EXPECT_TRUE(q) << why;
  return q ? q->value : 0;
}

TEST(Quantity, TakesEveryKindOfNumber) {
  EXPECT_NEAR(value(Take::minimum), -2, 1e-5);
  EXPECT_NEAR(value(Take::maximum), 2, 1e-5);
  EXPECT_EQ(value(Take::initial_value), 0);
  EXPECT_NEAR(value(Take::final_value), -2 * std::sin(5.0), 1e-12);
  EXPECT_NEAR(value(Take::time_of_minimum), std::acos(0.0) / 5, 1e-3);
  EXPECT_NEAR(value(Take::time_of_maximum), 3 * std::acos(0.0) / 5, 1e-3);
  EXPECT_NEAR(value(Take::first_time_below, -1), std::asin(0.5) / 5, 1e-6);
  EXPECT_NEAR(value(Take::first_time_above, 1), (std::acos(-1.0) + std::asin(0.5)) / 5, 1e-6);
  EXPECT_NEAR(value(Take::at_time), -2 * std::sin(5 * 0.1234567), 1e-5);
  EXPECT_NEAR(value(Take::mean_absolute_difference), 0.5, 1e-12);
}

TEST(Quantity, InterpolatesLinearlyBetweenRows) {
  HistoryTable const t{{{"time", "s"}, {"y", "Pa"}}, {{0, 1}, {0.1, 2}, {0.4, -4}}};
  std::string why;
  auto const at = [&](double time) {
    return measure({.name = "q", .column = "y", .take = Take::at_time, .time = time, .reference = {}}, t, why);
  };
  EXPECT_NEAR(at(0.025)->value, 1.25, 1e-14);
  EXPECT_NEAR(at(0.3)->value, -2, 1e-14);
  EXPECT_EQ(at(0.4)->value, -4);
  EXPECT_FALSE(at(0.5));
}

TEST(Quantity, FindsTheFirstPeakOfTheAbsoluteValueByAParabola) {
  EXPECT_NEAR(value(Take::first_peak), -2, 1e-9);
  EXPECT_NEAR(value(Take::time_of_first_peak), std::acos(0.0) / 5, 1e-7);
}

TEST(Quantity, PassesOverPeaksThatAreSmall) {
  auto const peak = first_peak({0, 1, 2, 3, 4, 5}, {0, 0.3, 0, -1, 0, 0});
  ASSERT_TRUE(peak);
  EXPECT_EQ(peak->time, 3);
  EXPECT_EQ(peak->value, -1);
  EXPECT_FALSE(first_peak({0, 1, 2}, {0, 1, 2}));
}

TEST(Quantity, IsShownInTheUnitAskedFor) {
  EXPECT_NEAR(value(Take::minimum, 0, "kPa"), -0.002, 1e-8);
  EXPECT_NEAR(value(Take::time_of_first_peak, 0, "ms"), 1000 * std::acos(0.0) / 5, 1e-4);
}

TEST(Quantity, SkipsEmptyCells) {
  HistoryTable const t{{{"time", "s"}, {"y", "Pa"}}, {{0, 1}, {1, std::numeric_limits<double>::quiet_NaN()}, {2, 3}}};
  std::string why;
  EXPECT_EQ(measure({.name = "q", .column = "y", .take = Take::maximum, .reference = {}}, t, why)->value, 3);
}

TEST(Quantity, SaysWhyItIsMissing) {
  std::string why;
  EXPECT_FALSE(measure({.name = "q", .column = "z", .reference = {}}, table(), why));
  EXPECT_EQ(why, "quantity 'q': history.csv has no column 'z'");
  EXPECT_FALSE(measure({.name = "q", .column = "y", .take = Take::first_time_above, .threshold = 99, .reference = {}},
                       table(), why));
  EXPECT_NE(why.find("does not contain it"), std::string::npos);
}

}  // namespace
}  // namespace piola
