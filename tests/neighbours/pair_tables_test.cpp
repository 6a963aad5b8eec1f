// SPDX-License-Identifier: Apache-2.0
#include "neighbours/decode.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using testing::SeenPair;
using testing::SeenPairs;
using testing::supports;
using testing::unit_box;

/// The same pairs with the same numbers, up to the rounding of X_b - X_a against multiples of the spacing.
void expect_same(SeenPairs const& a, SeenPairs const& b, double dx) {
  ASSERT_EQ(a.of.size(), b.of.size());
  for (std::size_t slot = 0; slot < a.of.size(); ++slot) {
    ASSERT_EQ(a.of[slot].size(), b.of[slot].size()) << "slot " << slot;
    for (std::size_t k = 0; k < a.of[slot].size(); ++k) {
      SeenPair const &p = a.of[slot][k], &q = b.of[slot][k];
      EXPECT_EQ(p.b, q.b);
      EXPECT_EQ(p.inner, q.inner);
      EXPECT_NEAR(p.l * dx * dx, q.l * dx * dx, 1e-12);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(p.r[c] / dx, q.r[c] / dx, 1e-12);
        EXPECT_NEAR(p.sr[c] * dx, q.sr[c] * dx, 1e-12);
      }
    }
  }
}

class PairTables : public ::testing::TestWithParam<std::tuple<int, double>> {};

TEST_P(PairTables, OfPatternsHoldThePairsOfTheList) {
  auto const [dimension, gradient] = GetParam();
  for (int const n : {4, 7}) {
    ParticleSet const set = unit_box(dimension, n);
    SeenPairs const list(set, supports(n, gradient, 1.2, 1, false));
    for (int const lanes : {1, 2, 4, 8}) {
      SeenPairs const stencil(set, supports(n, gradient, 1.2, lanes, true));
      ASSERT_TRUE(stencil.pairs.regular());
      ASSERT_FALSE(list.pairs.regular());
      expect_same(stencil, list, 1.0 / (n - 1));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, PairTables,
                         ::testing::Combine(::testing::Values(1, 2, 3), ::testing::Values(0.8, 1.0, 1.2)));

TEST(PairTables, OfPatternsHoldThePairsOfABallAndOfASecondBody) {
  ParticleSet set = unit_box(3, 3);
  ShapeSpec ball;
  ball.kind = ShapeSpec::Kind::sphere;
  ball.centre = {4, 0, 0};
  ball.radius = 1;
  ball.spacing = 0.3;
  fill(ball, "ball", set);
  double const dx = set.bodies[1].spacing[0];
  PairOptions options{find_kernel("cubic_spline"), 0.9 * dx, 1.2 * dx, 1, false};
  SeenPairs const list(set, options, 1);
  options.stencils = true;
  options.lanes = 8;
  expect_same(SeenPairs(set, options, 1), list, dx);
}

std::int64_t count(SeenPairs const& seen) {
  std::int64_t pairs = 0;
  for (Index a = 0; a < seen.order.particles; ++a) pairs += std::ssize(seen.at(a));
  return pairs;
}

TEST(PairTables, OfListsArePaddedToWholeGroupsWithTheParticleItself) {
  int const n = 5;
  ParticleSet const set = unit_box(3, n, 0.2);
  for (double const gradient : {0.9, 1.2})  // unequal supports: two weights; equal: one
    for (int const lanes : {1, 2, 4, 8}) {
      SeenPairs const seen(set, supports(n, gradient, 1.2, lanes));
      ListTable const t = seen.pairs.list();
      EXPECT_EQ(t.l == nullptr, gradient == 1.2);
      for (Index a = 0; a < seen.order.slots(); ++a) {
        EXPECT_EQ(t.begin[a] % lanes, 0);
        EXPECT_EQ(t.inner[a] % lanes, 0);
        EXPECT_LE(t.begin[a] + t.inner[a], t.begin[a + 1]);
        EXPECT_LT(t.begin[a + 1] - t.begin[a], static_cast<std::int64_t>(seen.at(a).size()) + 2 * lanes);
      }
      auto const stored = t.begin[seen.order.slots()];
      EXPECT_EQ(stored, count(seen) + seen.padding);
      EXPECT_EQ(lanes > 1, seen.padding > 0);
    }
}

TEST(PairTables, OfListsAreTheSameForEveryLaneCount) {
  ParticleSet const set = unit_box(3, 5, 0.2);
  SeenPairs const one(set, supports(5, 0.9, 1.2, 1));
  for (int const lanes : {2, 4, 8}) expect_same(SeenPairs(set, supports(5, 0.9, 1.2, lanes)), one, 0.25);
}

TEST(PairTables, KnowTheirSize) {
  ParticleSet const set = unit_box(3, 7), jittered = unit_box(3, 7, 0.2);
  SeenPairs const list(jittered, supports(7, 0.9, 1.2));
  EXPECT_GE(list.pairs.bytes(), static_cast<std::size_t>(count(list)) * (4 + 8 + 8));
  SeenPairs const stencil(set, supports(7, 0.9, 1.2, 8));
  EXPECT_GT(stencil.pairs.bytes(), 0U);
  EXPECT_LT(stencil.pairs.bytes(), list.pairs.bytes());
}

}  // namespace
}  // namespace piola
