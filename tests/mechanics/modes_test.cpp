// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/modes.hpp"
#include <gtest/gtest.h>
#include <set>

namespace piola {
namespace {

TEST(Modes, BeginAtRandomAndTheSameEachTime) {
  std::vector<double> mode(100, 0), again(100, 0);
  refresh_mode(mode);
  refresh_mode(again);
  EXPECT_EQ(mode, again);
  EXPECT_EQ(std::set<double>(mode.begin(), mode.end()).size(), mode.size()) << "no pattern";
  EXPECT_LE(largest_of(mode), 0.5);
  EXPECT_GT(largest_of(mode), 0.4);
}

TEST(Modes, KeepTheirShapeButForALittleAtRandom) {
  std::vector<double> mode{0, -8e-9, 4e-9};
  refresh_mode(mode);
  EXPECT_NEAR(mode[0], 0, 0.025);
  EXPECT_NEAR(mode[1], -1, 0.025);
  EXPECT_NEAR(mode[2], 0.5, 0.025);
  EXPECT_NE(mode[0], 0);
}

TEST(Modes, AreAsLargeAsTheirLargestComponentOfEitherSign) {
  EXPECT_EQ(largest_of({1, -3, 2}), 3);
  EXPECT_EQ(largest_of({}), 0);
}

}  // namespace
}  // namespace piola
