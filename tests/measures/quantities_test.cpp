// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/quantities.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace piola {
namespace {

using Statistic = QuantitySpec::Statistic;

/// -2 sin(5 t) up to t = 1: a negative peak at pi/10, a positive one at 3 pi/10.
HistoryTable table() {
  HistoryTable t{{{"time", "s"}, {"y", "Pa"}}, {}};
  for (int k = 0; k <= 1000; ++k) {
    double const time = 0.001 * k;
    t.rows.push_back({time, -2 * std::sin(5 * time)});
  }
  return t;
}

double value(Statistic take, double threshold = 0, std::string const& unit = "1") {
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
  EXPECT_NEAR(value(Statistic::minimum), -2, 1e-5);
  EXPECT_NEAR(value(Statistic::maximum), 2, 1e-5);
  EXPECT_EQ(value(Statistic::initial_value), 0);
  EXPECT_NEAR(value(Statistic::final_value), -2 * std::sin(5.0), 1e-12);
  EXPECT_NEAR(value(Statistic::time_of_minimum), std::acos(0.0) / 5, 1e-3);
  EXPECT_NEAR(value(Statistic::time_of_maximum), 3 * std::acos(0.0) / 5, 1e-3);
  EXPECT_NEAR(value(Statistic::first_time_below, -1), std::asin(0.5) / 5, 1e-6);
  EXPECT_NEAR(value(Statistic::first_time_above, 1), (std::acos(-1.0) + std::asin(0.5)) / 5, 1e-6);
  EXPECT_NEAR(value(Statistic::at_time), -2 * std::sin(5 * 0.1234567), 1e-5);
  EXPECT_NEAR(value(Statistic::mean_absolute_difference), 0.5, 1e-12);
}

TEST(Quantity, TakesTheMeanOverTime) {
  EXPECT_NEAR(value(Statistic::mean), -0.4 * (1 - std::cos(5.0)), 1e-5);
  QuantitySpec spec{.name = "q", .column = "y", .take = Statistic::mean, .reference = {}, .unit = "1"};
  spec.from = 0.25;
  spec.until = 0.75;
  std::string why;
  auto const q = measure(spec, table(), why);
  ASSERT_TRUE(q) << why;
  EXPECT_NEAR(q->value, -0.8 * (std::cos(1.25) - std::cos(3.75)), 1e-5);
  spec.from = spec.until = 0.5;
  EXPECT_NEAR(measure(spec, table(), why)->value, -2 * std::sin(2.5), 1e-12);
}

TEST(Quantity, TakesTheRange) { EXPECT_NEAR(value(Statistic::range), 4, 1e-5); }

// Against 0.8 of the column itself the relative error is 0.2/0.8, in percent if that is asked for.
TEST(Quantity, TakesTheRelativeErrorOverAllRows) {
  QuantitySpec spec{.name = "q",
                    .column = "y",
                    .take = Statistic::relative_error,
                    .reference = Expression("-1.6*sin(5*t)"),
                    .unit = "1"};
  std::string why;
  auto const q = measure(spec, table(), why);
  ASSERT_TRUE(q) << why;
  EXPECT_NEAR(q->value, 0.25, 1e-13);
  EXPECT_EQ(q->unit, "1");
  spec.unit = "%";
  EXPECT_NEAR(measure(spec, table(), why)->value, 25, 1e-11);
}

TEST(Quantity, ComparesOnlyTheRowsOfAWindow) {
  HistoryTable const t{{{"time", "s"}, {"y", "Pa"}}, {{0, 9}, {0.1, 3}, {0.3, -4}, {0.7, 9}}};
  QuantitySpec spec{.name = "q",
                    .column = "y",
                    .take = Statistic::relative_error,
                    .reference = Expression("2"),
                    .from = 0.1,
                    .until = 0.3};
  std::string why;
  EXPECT_NEAR(measure(spec, t, why)->value, std::sqrt((1.0 + 36) / (4 + 4)), 1e-15);
  spec.take = Statistic::mean_absolute_difference;
  EXPECT_NEAR(measure(spec, t, why)->value, (1.0 + 6) / 2, 1e-15);
  spec.from = 0.2;
  EXPECT_NEAR(measure(spec, t, why)->value, 6, 1e-15);
  spec.until = 0.25;
  EXPECT_FALSE(measure(spec, t, why));
}

TEST(Quantity, ExtremaAndThresholdsLookAtTheWindow) {
  HistoryTable const t{{{"time", "s"}, {"y", "Pa"}}, {{0, 9}, {0.1, 3}, {0.3, -4}, {0.7, 12}}};
  QuantitySpec spec{.name = "q", .column = "y", .take = Statistic::maximum, .reference = {}, .from = 0.1, .until = 0.3};
  std::string why;
  EXPECT_EQ(measure(spec, t, why)->value, 3);
  spec.take = Statistic::range;
  EXPECT_EQ(measure(spec, t, why)->value, 7);
  spec.take = Statistic::time_of_minimum;
  EXPECT_EQ(measure(spec, t, why)->value, 0.3);
  spec.take = Statistic::first_time_above;
  spec.threshold = 4;
  EXPECT_FALSE(measure(spec, t, why));
  spec.until = 1;
  EXPECT_NEAR(measure(spec, t, why)->value, 0.5, 1e-15);
}

// 3 + cos(20 t) over 1.2 s has the period pi/10; its mean is not 3, because the time is no whole number of periods.
TEST(Quantity, TakesTheMeanPeriodOfAnOscillation) {
  HistoryTable t{{{"time", "s"}, {"y", "Pa"}}, {}};
  for (int k = 0; k <= 12000; ++k) t.rows.push_back({1e-4 * k, 3 + std::cos(20 * 1e-4 * k)});
  QuantitySpec const spec{
      .name = "q", .column = "y", .take = Statistic::oscillation_period, .reference = {}, .unit = "ms"};
  std::string why;
  EXPECT_NEAR(measure(spec, t, why)->value, 100 * std::acos(-1.0), 1e-4);
  EXPECT_EQ(measure(spec, t, why)->unit, "ms");
  t.rows.resize(2500);  // 5 rad: two crossings
  EXPECT_FALSE(measure(spec, t, why));
}

// Crossings at 1 (a sample on the mean), 2.5 and 4 s.
TEST(Quantity, CountsACrossingOnASampleOnce) {
  HistoryTable const t{{{"time", "s"}, {"y", "Pa"}}, {{0, 1}, {1, 0}, {2, -1}, {3, 1}, {4, 0}, {5, -1}}};
  std::string why;
  EXPECT_NEAR(
      measure({.name = "q", .column = "y", .take = Statistic::oscillation_period, .reference = {}}, t, why)->value, 3,
      1e-14);
}

TEST(Quantity, InterpolatesLinearlyBetweenRows) {
  HistoryTable const t{{{"time", "s"}, {"y", "Pa"}}, {{0, 1}, {0.1, 2}, {0.4, -4}}};
  std::string why;
  auto const at = [&](double time) {
    return measure({.name = "q", .column = "y", .take = Statistic::at_time, .time = time, .reference = {}}, t, why);
  };
  EXPECT_NEAR(at(0.025)->value, 1.25, 1e-14);
  EXPECT_NEAR(at(0.3)->value, -2, 1e-14);
  EXPECT_EQ(at(0.4)->value, -4);
  EXPECT_FALSE(at(0.5));
}

// Linear between rows: 2 at 0.5 s, 5 at 1.5 s.
TEST(Quantity, TakesTheChangeFromOneTimeToAnother) {
  HistoryTable const t{{{"time", "s"}, {"y", "Pa"}}, {{0, 1}, {1, 3}, {2, 7}}};
  QuantitySpec spec{.name = "q", .column = "y", .take = Statistic::change, .reference = {}};
  std::string why;
  EXPECT_EQ(measure(spec, t, why)->value, 6);
  spec.from = 0.5;
  EXPECT_NEAR(measure(spec, t, why)->value, 5, 1e-14);
  EXPECT_EQ(measure(spec, t, why)->unit, "Pa");
  spec.until = 1.5;
  EXPECT_NEAR(measure(spec, t, why)->value, 3, 1e-14);
  spec.until = 2.5;
  EXPECT_FALSE(measure(spec, t, why));
}

TEST(Quantity, FindsTheFirstPeakOfTheAbsoluteValueByAParabola) {
  EXPECT_NEAR(value(Statistic::first_peak), -2, 1e-9);
  EXPECT_NEAR(value(Statistic::time_of_first_peak), std::acos(0.0) / 5, 1e-7);
}

TEST(Quantity, PassesOverPeaksThatAreSmall) {
  auto const peak = first_peak({0, 1, 2, 3, 4, 5}, {0, 0.3, 0, -1, 0, 0});
  ASSERT_TRUE(peak);
  EXPECT_EQ(peak->time, 3);
  EXPECT_EQ(peak->value, -1);
  EXPECT_FALSE(first_peak({0, 1, 2}, {0, 1, 2}));
}

TEST(Quantity, IsShownInTheUnitAskedFor) {
  EXPECT_NEAR(value(Statistic::minimum, 0, "kPa"), -0.002, 1e-8);
  EXPECT_NEAR(value(Statistic::time_of_first_peak, 0, "ms"), 1000 * std::acos(0.0) / 5, 1e-4);
}

TEST(Quantity, SkipsEmptyCells) {
  HistoryTable const t{{{"time", "s"}, {"y", "Pa"}}, {{0, 1}, {1, std::numeric_limits<double>::quiet_NaN()}, {2, 3}}};
  std::string why;
  EXPECT_EQ(measure({.name = "q", .column = "y", .take = Statistic::maximum, .reference = {}}, t, why)->value, 3);
}

TEST(Quantity, SaysWhyItIsMissing) {
  std::string why;
  EXPECT_FALSE(measure({.name = "q", .column = "z", .reference = {}}, table(), why));
  EXPECT_EQ(why, "quantity 'q': history.csv has no column 'z'");
  EXPECT_FALSE(
      measure({.name = "q", .column = "y", .take = Statistic::first_time_above, .threshold = 99, .reference = {}},
              table(), why));
  EXPECT_NE(why.find("does not contain it"), std::string::npos);
}

}  // namespace
}  // namespace piola
