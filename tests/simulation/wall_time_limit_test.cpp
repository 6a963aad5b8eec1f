// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/wall_time_limit.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

WallLimit limit_of(double seconds) { return {seconds, WallLimit::Clock::now()}; }

TEST(WallLimit, WithoutOneIsNeverReached) {
  WallLimit limit = limit_of(WallLimit::none);
  limit.step_took(1e9);
  limit.checkpoint_took(1e9);
  EXPECT_FALSE(limit.exists());
  EXPECT_FALSE(limit.reached());
}

TEST(WallLimit, LeavesTimeForTheSlowestStepAndACheckpoint) {
  WallLimit limit = limit_of(1000);
  limit.step_took(10);
  limit.step_took(20);  // with a frame, say
  limit.step_took(2);
  limit.checkpoint_took(30);
  limit.checkpoint_took(40);
  limit.checkpoint_took(7);
  EXPECT_DOUBLE_EQ(limit.reserve(), 1.5 * 20 + 2 * 40 + 5);
  EXPECT_FALSE(limit.reached_after(1000 - 116));
  EXPECT_TRUE(limit.reached_after(1000 - 115));
}

TEST(WallLimit, EstimatesCheckpointsUntilOneWasWritten) {
  WallLimit limit = limit_of(7200);
  limit.checkpoint_has(3'000'000'000);
  EXPECT_GE(limit.reserve(), 36 + 60) << "3 GB to a network disk at 50 MB/s";
  limit.checkpoint_took(3);
  EXPECT_DOUBLE_EQ(limit.reserve(), 36 + 6);
}

TEST(WallLimit, CountsFromItsStart) {
  WallLimit const over(5, WallLimit::Clock::now() - std::chrono::seconds(6));
  EXPECT_TRUE(over.reached());
  EXPECT_FALSE(limit_of(5).reached());
}

}  // namespace
}  // namespace piola
