// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/prescribed.hpp"
#include "piola/mechanics/load.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace piola {
namespace {

constexpr double round_off = 1e-15;

std::array<Expression, 3> formulas(std::string const& x, std::string const& y = "0", std::string const& z = "0") {
  return {Expression(x), Expression(y), Expression(z)};
}

TEST(Release, CountsAsReachedToRoundOffOfASumOfSteps) {
  EXPECT_FALSE(has_ended(1e-3, 0));
  EXPECT_FALSE(has_ended(1e-3, 0.999e-3));
  EXPECT_TRUE(has_ended(1e-3, 1e-3));
  EXPECT_TRUE(has_ended(1e-3, 2e-3));
  EXPECT_FALSE(has_ended(std::numeric_limits<double>::infinity(), 1e300));
  double time = 0;
  for (int k = 0; k < 1000; ++k) time += 1e-6;
  EXPECT_TRUE(has_ended(1e-3, time));
}

TEST(Formulas, AreSteadyIfNoneHasTheTimeInIt) {
  EXPECT_TRUE(is_steady(formulas("X", "Y*Z", "3")));
  EXPECT_FALSE(is_steady(formulas("X", "Y", "sin(t)")));
  EXPECT_FALSE(is_steady(formulas("t", "0", "0")));
}

TEST(Directions, AreMadeOrthogonalToOthers) {
  Direction d{1, 1, 0};
  EXPECT_TRUE(make_orthogonal(d, {{1, 0, 0}}));
  EXPECT_EQ(d, (Direction{0, 1, 0}));
  d = {3, 0, 4};
  EXPECT_TRUE(make_orthogonal(d, {}));
  EXPECT_NEAR(d[0], 0.6, round_off);
  EXPECT_NEAR(d[2], 0.8, round_off);
  d = {2, 0, 0};
  EXPECT_FALSE(make_orthogonal(d, {{1, 0, 0}})) << "nothing is left";
  d = {1, 2, 3};
  EXPECT_FALSE(make_orthogonal(d, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
}

TEST(DirectionsOfASupport, AreAxesOfTheBody) {
  Support s;
  s.fix = {true, false, true};
  EXPECT_EQ(directions_of(s, 3), (std::vector<Direction>{{1, 0, 0}, {0, 0, 1}}));
  EXPECT_EQ(directions_of(s, 2), (std::vector<Direction>{{1, 0, 0}})) << "there is no z in two dimensions";
  EXPECT_EQ(directions_of(s, 1), (std::vector<Direction>{{1, 0, 0}}));
  s.fix = {};
  EXPECT_TRUE(directions_of(s, 3).empty());
}

TEST(DirectionsOfASupport, AreTheNormalOrThoseAcrossIt) {
  Support s;
  s.frame = Support::Frame::normal;
  s.normal = {0.6, 0.8, 0};
  auto const along = directions_of(s, 2);
  ASSERT_EQ(along.size(), 1u);
  EXPECT_NEAR(dot(along[0], s.normal), 1, round_off);
  s.frame = Support::Frame::tangent;
  for (int D = 2; D <= 3; ++D) {
    auto const across = directions_of(s, D);
    ASSERT_EQ(across.size(), static_cast<std::size_t>(D - 1));
    for (std::size_t k = 0; k < across.size(); ++k) {
      EXPECT_NEAR(dot(across[k], s.normal), 0, round_off);
      for (std::size_t l = 0; l < across.size(); ++l) EXPECT_NEAR(dot(across[k], across[l]), k == l ? 1 : 0, round_off);
    }
  }
}

TEST(DirectionsOfASupport, AlongAnAxisAreExactlyThatAxis) {
  Support s;
  s.frame = Support::Frame::normal;
  s.normal = {1e-14, -1 + 1e-14, 0};
  EXPECT_EQ(directions_of(s, 3), (std::vector<Direction>{{0, 1, 0}}));
  s.frame = Support::Frame::tangent;
  EXPECT_EQ(directions_of(s, 3), (std::vector<Direction>{{1, 0, 0}, {0, 0, 1}}));
}

TEST(Speed, IsTheVelocityAlongADirection) {
  auto const velocity = formulas("X*t", "2*Y", "-1");
  EXPECT_EQ(speed_along(velocity, {1, 0, 0}, {3, 4, 5}, 2), 6);
  EXPECT_EQ(speed_along(velocity, {0, 1, 0}, {3, 4, 5}, 2), 8);
  EXPECT_NEAR(speed_along(velocity, {0.6, 0, 0.8}, {3, 4, 5}, 2), 0.6 * 6 - 0.8, round_off * 10);
}

TEST(StepsBeforeARelease, EndOnItAndAreAlike) {
  EXPECT_EQ(clip_step_to_end_time(1, std::numeric_limits<double>::infinity()), 1);
  EXPECT_EQ(clip_step_to_end_time(1, 100), 1) << "far away: nothing changes";
  for (double const rest : {0.3, 1.0, 1.5, 2.01, 7.7, 19.5}) {
    double left = rest, smallest = 1, largest = 0;
    int steps = 0;
    for (; left > 1e-9 && steps < 100; ++steps) {
      double const dt = clip_step_to_end_time(1, left);
      smallest = std::min(smallest, dt);
      largest = std::max(largest, dt);
      left -= dt;
    }
    EXPECT_NEAR(left, 0, 1e-12) << rest;
    EXPECT_EQ(steps, static_cast<int>(std::ceil(rest))) << rest;
    EXPECT_NEAR(smallest, largest, 1e-12) << rest << ": none is a sliver";
  }
}

TEST(StepsBeforeARelease, AreNeverOfNoLength) {
  EXPECT_GT(clip_step_to_end_time(1, 0), 0);
  EXPECT_GT(clip_step_to_end_time(1, 1e-12), 0);
}

TEST(HeldDirections, OfRowsTakeWhatThoseBeforeLeaveFree) {
  auto const held = hold_along({{1, 0, 0}, {0.6, 0.8, 0}, {0, 1, 0}, {0, 0, 1}});
  ASSERT_EQ(held.size(), 3U);
  EXPECT_EQ(held[0].direction, (Direction{1, 0, 0}));
  EXPECT_NEAR(held[1].direction[1], 1, round_off);
  EXPECT_EQ(held[1].row, 1U);
  EXPECT_EQ(held[2].row, 3U) << "the third asks for nothing that is free";
}

/// The speeds along all rows that count are then those that were asked for.
TEST(HeldDirections, MoveAsTheirRowsAsk) {
  std::vector<Direction> const rows{{1, 0, 0}, {0.6, 0.8, 0}, {0.48, 0.36, 0.8}};
  std::array const asked{2.0, -1.0, 5.0};
  Direction v{};
  for (PrescribedAxis const& along : hold_along(rows)) {
    double const speed = along.speed([&](std::size_t row) { return asked[row]; });
    for (std::size_t c = 0; c < 3; ++c) v[c] += speed * along.direction[c];
  }
  for (std::size_t row = 0; row < 3; ++row) EXPECT_NEAR(dot(v, rows[row]), asked[row], 20 * round_off);
}

TEST(Release, TheNextIsTheFirstAfterATimeOfAllThatEnd) {
  std::vector<Support> supports(2);
  supports[0].until = 3;
  std::vector<Load> loads(2);
  loads[1].until = 2;
  EXPECT_EQ(next_end_time(0, supports, loads), 2);
  EXPECT_EQ(next_end_time(2, supports, loads), 3);
  EXPECT_EQ(next_end_time(3, supports, loads), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace piola
