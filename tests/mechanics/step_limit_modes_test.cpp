// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/step_limit_modes.hpp"
#include <gtest/gtest.h>
#include <set>
#include <vector>

namespace piola {
namespace {

TEST(Modes, BeginAtRandomAndTheSameEachTime) {
  std::vector<double> mode, again;
  for (std::uint64_t k = 0; k < 100; ++k) {
    mode.push_back(refreshed(0, 0, k));
    again.push_back(refreshed(0, 0, k));
  }
  EXPECT_EQ(mode, again);
  EXPECT_EQ(std::set<double>(mode.begin(), mode.end()).size(), mode.size()) << "no pattern";
  EXPECT_LE(largest_of(mode), 0.5);
  EXPECT_GT(largest_of(mode), 0.4);
}

TEST(Modes, KeepTheirShapeButForALittleAtRandom) {
  double const most = 8e-9;
  EXPECT_NEAR(refreshed(0, most, 0), 0, 0.025);
  EXPECT_NEAR(refreshed(-8e-9, most, 1), -1, 0.025);
  EXPECT_NEAR(refreshed(4e-9, most, 2), 0.5, 0.025);
  EXPECT_NE(refreshed(0, most, 0), 0);
}

TEST(Modes, AreAsLargeAsTheirLargestComponentOfEitherSign) {
  EXPECT_EQ(largest_of(std::vector<double>{1, -3, 2}), 3);
  EXPECT_EQ(largest_of(std::vector<double>{}), 0);
}

}  // namespace
}  // namespace piola
