// SPDX-License-Identifier: Apache-2.0
#include "piola/base/units.hpp"
#include "piola/base/text.hpp"
#include "support/key_words.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <stdexcept>
#include <thread>

namespace piola {
namespace {

using test::mentions;

double value_of(std::string_view text, std::string_view unit) {
  Quantity const quantity = read_quantity(text, unit);
  EXPECT_FALSE(quantity.problem) << *quantity.problem;
  return quantity.value;
}

std::string problem_of(std::string_view text, std::string_view unit) {
  return read_quantity(text, unit).problem.value_or("no problem");
}

TEST(Units, QuantitiesAreConvertedToSi) {
  EXPECT_DOUBLE_EQ(value_of("17 MPa", "Pa"), 17e6);
  EXPECT_DOUBLE_EQ(value_of("5 mm", "m"), 0.005);
  EXPECT_DOUBLE_EQ(value_of("153 us", "s"), 153e-6);
  EXPECT_DOUBLE_EQ(value_of("1.1 g/cm^3", "kg/m^3"), 1100);
  EXPECT_DOUBLE_EQ(value_of("36 km/h", "m/s"), 10);
  EXPECT_DOUBLE_EQ(value_of("-0.5 m", "m"), -0.5);
  EXPECT_DOUBLE_EQ(value_of("+2e-1m", "m"), 0.2);
  EXPECT_DOUBLE_EQ(value_of("  3  ", "m"), 3);
  EXPECT_DOUBLE_EQ(value_of("30 %", "1"), 0.3);
  EXPECT_DOUBLE_EQ(value_of("180 degree", "rad"), std::acos(-1.0));
  EXPECT_DOUBLE_EQ(value_of("0.01 1/ms", "1/s"), 10);
  EXPECT_DOUBLE_EQ(value_of("10 Hz", "1/s"), 10);
  EXPECT_EQ(problem_of("10 s", "1/s"), "\"10 s\" is not a rate (expected a unit such as 1/s)");
  EXPECT_TRUE(mentions(problem_of("10 1/2 s", "1/s"), {"\"1/2 s\"", "\"10 1/2 s\"", "not a unit", "1/s"}));
}

TEST(Units, OffsetUnitsAreConvertedWithTheirOffset) { EXPECT_DOUBLE_EQ(value_of("20 degC", "K"), 293.15); }

TEST(Units, AWrongUnitNamesWhatIsExpected) {
  EXPECT_EQ(problem_of("5 MPa", "m"), "\"5 MPa\" is not a length (expected a unit such as m)");
  EXPECT_EQ(problem_of("5 m", "Pa"), "\"5 m\" is not a pressure or modulus (expected a unit such as Pa)");
  EXPECT_EQ(problem_of("5 m", "1"), "\"5 m\" is not a pure number (expected no unit)");
  EXPECT_TRUE(mentions(problem_of("5 parsnips", "m"), {"\"parsnips\"", "\"5 parsnips\"", "not a unit", "such as m"}));
  EXPECT_TRUE(mentions(problem_of("tall", "m"), {"\"tall\"", "not a number with a unit", "\"2 m\""}));
}

TEST(Units, WhatOnlyLooksLikeAQuantityIsRefused) {
  for (std::string_view const text : {"", " ", "nan m", "inf", "-", "1e999 m", "10 6 m", "5 m m",
                                      "5 s since 2000-01-01", "3 lg(re 1 m)", "5 m @ 3", "1,5 m", "0x10 m", "5 m\n"}) {
    EXPECT_TRUE(read_quantity(text, "m").problem) << text;
  }
}

TEST(Units, AnyQuantityIsReducedToBaseUnits) {
  EXPECT_DOUBLE_EQ(read_any_quantity("17 MPa").value, 17e6);
  EXPECT_DOUBLE_EQ(read_any_quantity("105 rad/s").value, 105);
  EXPECT_DOUBLE_EQ(read_any_quantity("20 degC").value, 293.15);
  EXPECT_DOUBLE_EQ(read_any_quantity("6").value, 6);
  EXPECT_DOUBLE_EQ(read_any_quantity("50 %").value, 0.5);
  EXPECT_TRUE(read_any_quantity("5 parsnips").problem);
  EXPECT_TRUE(read_any_quantity("fast").problem);
}

TEST(Units, ValuesAreConvertedBackForPrinting) {
  EXPECT_DOUBLE_EQ(convert_from_si(17e6, "Pa", "MPa"), 17);
  EXPECT_THROW(convert_from_si(1, "Pa", "m"), std::invalid_argument);
  EXPECT_TRUE(same_dimension("mm", "m"));
  EXPECT_FALSE(same_dimension("mm", "s"));
  EXPECT_FALSE(same_dimension("parsnips", "s"));
}

// 1 MPa mm^0.5 = 1e6 sqrt(1e-3) Pa m^0.5.
TEST(Units, TheLastFactorMayHaveAHalfPower) {
  EXPECT_DOUBLE_EQ(value_of("2 MPa m^0.5", "Pa m^0.5"), 2e6);
  EXPECT_DOUBLE_EQ(value_of("-2 MPa.mm^0.5", "Pa m^0.5"), -2e6 * std::sqrt(1e-3));
  EXPECT_DOUBLE_EQ(value_of("3 kg/s^2 mm^0.5", "N/m m^0.5"), 3 * std::sqrt(1e-3));
  EXPECT_DOUBLE_EQ(value_of("4 mm^0.5", "m^0.5"), 4 * std::sqrt(1e-3));
  EXPECT_DOUBLE_EQ(read_any_quantity("2 MPa mm^0.5").value, 2e6 * std::sqrt(1e-3));
  EXPECT_DOUBLE_EQ(convert_from_si(5e6, "Pa m^0.5", "MPa m^0.5"), 5);
  EXPECT_TRUE(same_dimension("Pa m^0.5", "kPa mm^0.5"));
  EXPECT_FALSE(same_dimension("Pa m^0.5", "Pa m"));
  EXPECT_FALSE(same_dimension("Pa m^0.5", "Pa^2 m"));
  EXPECT_TRUE(mentions(problem_of("5 MPa", "Pa m^0.5"), {"5 MPa", "stress intensity factor", "Pa m^0.5"}));
  for (std::string_view const text :
       {"5 ^0.5", "5 Pa ^0.5", "5 Pa/m^0.5", "5 Pa m^0.5^0.5", "5 Pa m^0.5 m^0.5", "5 m^0.5 Pa", "5 Pa m^1.5"})
    EXPECT_TRUE(read_quantity(text, "Pa m^0.5").problem) << text;
}

TEST(Units, ReadingIsSafeFromSeveralThreads) {
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([] {
      for (int k = 0; k < 200; ++k) {
        EXPECT_DOUBLE_EQ(read_quantity("5 mm", "m").value, 0.005);
        EXPECT_TRUE(read_quantity("5 MPa", "m").problem);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(Units, EveryNumberSurvivesBeingWrittenAndRead) {
  EXPECT_TRUE(rc::check("a number and its text with a unit are the same", [](double value) {
    RC_PRE(std::isfinite(value));
    RC_ASSERT(read_quantity(exact_text(value) + " m", "m").value == value);
  }));
}

TEST(Units, NoTextThrowsOrGivesAnInfiniteValue) {
  EXPECT_TRUE(rc::check("any text is read or refused", [](std::string const& text) {
    Quantity const quantity = read_quantity("1 " + text, "m");
    RC_ASSERT(quantity.problem || std::isfinite(quantity.value));
    read_any_quantity(text);
  }));
}

}  // namespace
}  // namespace piola
