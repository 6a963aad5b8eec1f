// SPDX-License-Identifier: Apache-2.0
// [constants]: numbers, quantities and formulas of other constants.
#include "piola/input/sections.hpp"
#include "support/key_words.hpp"
#include <gtest/gtest.h>
#include <numbers>

namespace piola {
namespace {

using test::expect_words;

struct Outcome {
  std::map<std::string, double> values;
  std::string problems;
};

Outcome read(std::string const& lines) {
  Problems problems;
  Outcome outcome;
  auto const document = parse_document("[constants]\n" + lines, "case.toml", problems);
  if (document) outcome.values = read_constants({*document->root.find("constants"), "constants"}, problems);
  for (std::string const& line : problems.lines()) outcome.problems += line + "\n";
  return outcome;
}

TEST(Constants, AreNumbersQuantitiesAndFormulasInAnyOrder) {
  Outcome const of = read(
      "a = \"2*pi*b\"\nb = \"c + 1\"\nc = 3\nL = \"5 mm\"\nrate = \"2 1/s\"\nd = \"-2.5e-3\"\n"
      "area = \"pi*L^2\"\ne = \"max(c, d)\"\nsame = \"L\"\n");
  EXPECT_EQ(of.problems, "");
  EXPECT_DOUBLE_EQ(of.values.at("a"), 8 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(of.values.at("b"), 4);
  EXPECT_DOUBLE_EQ(of.values.at("L"), 5e-3);
  EXPECT_DOUBLE_EQ(of.values.at("rate"), 2);
  EXPECT_DOUBLE_EQ(of.values.at("d"), -2.5e-3);
  EXPECT_DOUBLE_EQ(of.values.at("area"), std::numbers::pi * 25e-6);
  EXPECT_DOUBLE_EQ(of.values.at("e"), 3);
  EXPECT_DOUBLE_EQ(of.values.at("same"), 5e-3);
}

TEST(Constants, ThatGoRoundInARingAreReportedOnce) {
  Outcome const of = read("a = \"b + 1\"\nb = \"2*c\"\nc = \"a\"\nd = \"d\"\ne = \"1 + a\"\n");
  expect_words(of.problems,
               {"constants.a depends on itself (a -> b -> c -> a", "constants.d depends on itself (d -> d"});
  EXPECT_EQ(std::count(of.problems.begin(), of.problems.end(), '\n'), 2) << of.problems;
  EXPECT_EQ(of.values.size(), 5U) << "formulas of the case do not complain again";
}

TEST(Constants, InLongChainsAreRefusedInGoodTime) {
  std::string chain = "c0 = 1\n", backwards;
  for (int k = 1; k < 100; ++k) chain += "c" + std::to_string(k) + " = \"c" + std::to_string(k - 1) + " + 1\"\n";
  EXPECT_EQ(read(chain).values.at("c99"), 100);
  for (int k = 20000; k > 0; --k) backwards += "d" + std::to_string(k) + " = \"d" + std::to_string(k - 1) + "\"\n";
  expect_words(read(backwards + "d0 = 1\n").problems, {"used by a constant that is used by another", "200 times"});
}

TEST(Constants, OfUnknownNamesPlacesAndNonsenseAreReported) {
  expect_words(read("alpha = 1\na = \"2*alpa\"\n").problems,
               {"case.toml:3:", "constants.a, formula", "alpa", "\"alpha\""});
  expect_words(read("a = \"2*X\"\n").problems, {"constants.a depends on X", "other constants"});
  expect_words(read("b = 0\na = \"1/b\"\n").problems, {"constants.a is inf (allowed: a finite number)", "division"});
  expect_words(read("a = \"sqrt(-1)\"\n").problems, {"constants.a is not a number", "root of a negative"});
  expect_words(read("a = \"2*\"\n").problems, {"constants.a, formula \"2*\""});
  expect_words(read("a = \"5 parsnips\"\n").problems, {"constants.a cannot be read", "parsnips"});
  expect_words(read("pi = 3\n").problems, {"\"pi\" already has a meaning in formulas"});
  expect_words(read("a = true\nb = \"a\"\n").problems, {"constants.a is true"});
  EXPECT_EQ(read("a = true\nb = \"1/a\"\n").problems.find("constants.b"), std::string::npos);
}

}  // namespace
}  // namespace piola
