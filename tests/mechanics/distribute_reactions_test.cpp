// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/distribute_reactions.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

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

TEST(SharedReactions, DoNotDependOnTheOrderOfRows) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> some(-1, 1);
  std::vector<SupportRow> rows;
  for (std::size_t k = 0; k < 60; ++k) {
    double const angle = some(random);
    rows.push_back({k % 3,
                    {some(random), some(random), some(random)},
                    {std::cos(angle), std::sin(angle), 0},
                    1 + static_cast<double>(k) / 7});
  }
  ImpulseSum push;
  push.add({0.3, -0.2, 0.7}, {4, 5, 0});
  auto const shares = [&] {
    std::vector<Impulse> of_support(3);
    share_out(rows, push.value(), of_support);
    std::vector<double> all;
    for (Impulse const& i : of_support) {
      all.insert(all.end(), i.linear.begin(), i.linear.end());
      all.insert(all.end(), i.angular.begin(), i.angular.end());
    }
    return all;
  };
  auto const reference = shares();
  for (int k = 0; k < 20; ++k) {
    std::shuffle(rows.begin(), rows.end(), random);
    EXPECT_EQ(shares(), reference);
  }
}

}  // namespace
}  // namespace piola
