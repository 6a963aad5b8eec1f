// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/shared_reactions.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

/// Two supports at the ends of a beam, each of which holds two particles in y: statics decides.
TEST(SharedReactions, AreThoseOfStaticsWhereTheseDecide) {
  std::vector<SupportRow> const rows{{0, {0, 0, 0}, {0, 1, 0}, 1}, {1, {2, 0, 0}, {0, 1, 0}, 1}};
  ImpulseSum push;
  push.add({0.5, 0, 0}, {0, 8, 0});
  Impulse const rest = push.value();
  std::vector<Impulse> of_support(2);
  share_out(rows, rest, of_support);
  EXPECT_NEAR(of_support[0].linear[1], 6, 1e-12);
  EXPECT_NEAR(of_support[1].linear[1], 2, 1e-12);
  EXPECT_NEAR(of_support[0].angular[2] + of_support[1].angular[2], rest.angular[2], 1e-12);
}

TEST(SharedReactions, GoByMassAndLeaveOutWhatNothingHolds) {
  std::vector<SupportRow> const rows{{0, {0, 0, 0}, {1, 0, 0}, 1}, {1, {1, 0, 0}, {1, 0, 0}, 3}};
  ImpulseSum push;
  push.add({0, 0, 0}, {4, 5, 0});
  Impulse const rest = push.value();
  std::vector<Impulse> of_support(2);
  share_out(rows, rest, of_support);
  EXPECT_NEAR(of_support[0].linear[0], 1, 1e-12);
  EXPECT_NEAR(of_support[1].linear[0], 3, 1e-12);
  EXPECT_EQ(of_support[0].linear[1] + of_support[1].linear[1], 0);
}

}  // namespace
}  // namespace piola
