// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

TEST(Text, EditDistanceCountsInsertionsDeletionsSubstitutionsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("density", "density"), 0);
  EXPECT_EQ(edit_distance("densty", "density"), 1);
  EXPECT_EQ(edit_distance("denisty", "density"), 1);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(Text, NearestNameIsFoundForASlipAndNotForAnotherWord) {
  std::vector<std::string> const known{"density", "youngs_modulus", "poissons_ratio"};
  EXPECT_EQ(nearest_name("poisson_ratio", known), "poissons_ratio");
  EXPECT_EQ(nearest_name("desnity", known), "density");
  EXPECT_EQ(nearest_name("youngs", known), "youngs_modulus");
  EXPECT_FALSE(nearest_name("viscosity", known));
  EXPECT_EQ(nearest_name("DENSITY", known), "density");
  EXPECT_EQ(nearest_name("Youngs", known), "youngs_modulus");
  std::vector<std::string> const fields{"Velocity", "VonMisesStress", "Volume"};
  EXPECT_EQ(nearest_name("velocity", fields), "Velocity");
  EXPECT_EQ(nearest_name("von_mises_stress", fields), "VonMisesStress");
  EXPECT_EQ(known_names_text("x", fields), "Velocity, VonMisesStress, Volume");
  EXPECT_FALSE(nearest_name("", known));
  EXPECT_EQ(advice_for_name("densitx", known), "did you mean \"density\"?");
  EXPECT_EQ(advice_for_name("viscosity", known), "choose one of these");
}

TEST(Text, QuotedMakesControlCharactersVisibleAndKeepsItShort) {
  EXPECT_EQ(in_quotes("a b"), "\"a b\"");
  EXPECT_EQ(in_quotes("a\nb\x01"), "\"a\\nb\\x01\"");
  EXPECT_LT(in_quotes(std::string(10000, 'x')).size(), 130u);
  EXPECT_EQ(in_quotes("\xc3\xa9"), "\"\xc3\xa9\"");
}

TEST(Text, NamesAreLettersDigitsAndUnderscores) {
  EXPECT_TRUE(is_name("column_2"));
  EXPECT_FALSE(is_name(""));
  EXPECT_FALSE(is_name("2nd"));
  EXPECT_FALSE(is_name("a.b"));
  EXPECT_FALSE(is_name(std::string(65, 'a')));
}

TEST(Text, NumbersAreWrittenForPeople) {
  EXPECT_EQ(number_text(0.3), "0.3");
  EXPECT_EQ(number_text(1.0 / 3, 3), "0.333");
  EXPECT_EQ(number_text(std::nan("")), "not a number");
  EXPECT_EQ(number_text(-std::nan(""), 2), "not a number");
  EXPECT_EQ(exact_text(0.1), "0.1");
  EXPECT_EQ(count_text(0), "0");
  EXPECT_EQ(count_text(999), "999");
  EXPECT_EQ(count_text(1234567), "1,234,567");
  EXPECT_EQ(count_text(-1234), "-1,234");
}

TEST(Text, QuantitiesCarryAPrefixWhereThatIsUsual) {
  EXPECT_EQ(quantity_text(17e6, "Pa"), "17 MPa");
  EXPECT_EQ(quantity_text(-std::nan(""), "J"), "not a number");
  EXPECT_EQ(quantity_text(1.53e-4, "s"), "153 us");
  EXPECT_EQ(quantity_text(3600, "s"), "3600 s");
  EXPECT_EQ(quantity_text(0.25, "m"), "250 mm");
  EXPECT_EQ(quantity_text(0, "Pa"), "0 Pa");
  EXPECT_EQ(quantity_text(1100, "kg/m^3"), "1100 kg/m^3");
  EXPECT_EQ(quantity_text(0.45, "1"), "0.45");
}

TEST(Text, DurationsAndSizesAreWrittenForPeople) {
  EXPECT_EQ(duration_text(0.35), "0.35 s");
  EXPECT_EQ(duration_text(12.3), "12 s");
  EXPECT_EQ(duration_text(185), "3 min 05 s");
  EXPECT_EQ(duration_text(3720), "1 h 02 min");
  EXPECT_EQ(duration_text(183600), "2 d 03 h");
  EXPECT_EQ(duration_text(-1), "unknown");
  EXPECT_EQ(size_text(0), "0 B");
  EXPECT_EQ(size_text(1234), "1.2 kB");
  EXPECT_EQ(size_text(2.56e9), "2.6 GB");
  EXPECT_EQ(size_text(256e6), "256 MB");
}

}  // namespace
}  // namespace piola
