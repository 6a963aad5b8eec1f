// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/cracks.hpp"
#include "piola/base/errors.hpp"
#include "piola/setup/shapes.hpp"
#include "support/key_words.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

namespace piola {
namespace {

using test::mentions;

using Vec3 = std::array<double, 3>;

/// A plate of 2 m x 1 m with the spacing 0.25 m: 9 x 5 particles.
ShapeSpec plate() {
  ShapeSpec shape;
  shape.dimension = 2;
  shape.max = {2, 1, 0};
  shape.particles = {9, 5, 1};
  return shape;
}

ParticleSet filled(ShapeSpec const& shape = plate()) {
  ParticleSet set;
  fill(shape, "plate", set);
  return set;
}

double total(std::vector<double> const& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

std::string problem(Vec3 const& from, Vec3 const& to, ShapeSpec const& shape = plate()) {
  return trace_crack(filled(shape), 0, from, to).problem;
}

TEST(Crack, DoublesItsParticlesButForTheTip) {
  ParticleSet const before = filled();
  ParticleSet set = before;
  open_crack(set, 0, {0, 0.5, 0}, {1, 0.5, 0});
  EXPECT_EQ(set.size(), 49);
  EXPECT_EQ(set.bodies[0].last, 49);
  EXPECT_FALSE(set.bodies[0].regular);
  ASSERT_EQ(set.crack_side.size(), 49u);
  EXPECT_EQ(std::count(set.crack_side.begin(), set.crack_side.end(), 0), 41);
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t const original = 18 + k, copy = 45 + k;
    EXPECT_EQ(set.crack_side[original], 1);
    EXPECT_EQ(set.crack_side[copy], -1);
    EXPECT_EQ(set.X[copy], (Vec3{0.25 * static_cast<double>(k), 0.5, 0}));
    EXPECT_EQ(set.X[copy], set.X[original]);
    EXPECT_EQ(set.lattice_index[copy], set.lattice_index[original]);
    EXPECT_EQ(set.body[copy], 0);
    EXPECT_EQ(set.volume[copy], before.volume[original] / 2);
    EXPECT_EQ(set.volume[original], before.volume[original] / 2);
    EXPECT_EQ(set.kernel_volume[copy], before.kernel_volume[original]);
    EXPECT_EQ(set.kernel_volume[original], before.kernel_volume[original]);
  }
  EXPECT_EQ(set.crack_side[22], 0);  // the tip at (1, 0.5)
  EXPECT_EQ(set.volume[22], before.volume[22]);
  EXPECT_DOUBLE_EQ(total(set.volume), 2);
}

TEST(Crack, EndsInsideTheBodyAreTips) {
  auto const tips = [](Vec3 const& from, Vec3 const& to) {
    ParticleSet set = filled();
    open_crack(set, 0, from, to);
    Crack const& crack = set.cracks.at(0);
    EXPECT_EQ(crack.from, from);
    EXPECT_EQ(crack.to, to);
    return std::array{crack.tip_at_from, crack.tip_at_to};
  };
  EXPECT_EQ(tips({0, 0.5, 0}, {1, 0.5, 0}), (std::array{false, true}));
  EXPECT_EQ(tips({1, 0.5, 0}, {0, 0.5, 0}), (std::array{true, false}));
  EXPECT_EQ(tips({0.5, 0.5, 0}, {1.5, 0.5, 0}), (std::array{true, true}));
  EXPECT_EQ(tips({1, 0, 0}, {1, 1, 0}), (std::array{false, false}));
  EXPECT_EQ(tips({0, 0, 0}, {0.75, 0.75, 0}), (std::array{false, true}));
}

TEST(Crack, ABodyWithTwoTipsAndThreeParticlesHasOneDouble) {
  ParticleSet set = filled();
  open_crack(set, 0, {1, 0.25, 0}, {1, 0.75, 0});
  EXPECT_EQ(set.size(), 46);
  EXPECT_EQ(set.X[45], (Vec3{1, 0.5, 0}));
}

TEST(Crack, LaterBodiesFollowAndHaveASideToo) {
  ParticleSet set;
  ShapeSpec const shape = plate();
  fill(shape, "first", set);
  open_crack(set, 0, {0, 0.5, 0}, {1, 0.5, 0});
  open_crack(set, 0, {2, 0.5, 0}, {1.5, 0.5, 0});
  fill(shape, "second", set);
  open_crack(set, 1, {1, 1, 0}, {1, 0.5, 0});
  EXPECT_EQ(set.bodies[0].last, 45 + 4 + 2);
  EXPECT_EQ(set.bodies[1].first, set.bodies[0].last);
  EXPECT_EQ(set.bodies[1].last, set.size());
  EXPECT_EQ(set.crack_side.size(), set.X.size());
  ASSERT_EQ(set.cracks.size(), 3u);
  EXPECT_EQ(set.cracks[2].body, 1);
  for (std::int64_t id = 0; id < set.size(); ++id)
    EXPECT_EQ(set.body[static_cast<std::size_t>(id)], id < set.bodies[0].last ? 0 : 1);
}

TEST(Crack, EndsMayBeOffByLessThanAMillionthOfTheSpacing) {
  EXPECT_EQ(problem({0, 0.5 + 2e-7, 0}, {1 - 2e-7, 0.5, 0}), "");
  EXPECT_NE(problem({0, 0.5 + 3e-7, 0}, {1, 0.5, 0}), "");
  EXPECT_NE(problem({0, 0.5, 0}, {1 + 3e-7, 0.5, 0}), "");
}

TEST(Crack, WhatCannotBeACrackSaysWhy) {
  EXPECT_TRUE(
      mentions(problem({1, 0.5, 0}, {1, 0.5, 0}), {"plate", "no length", "two different ends", "move one end"}));
  EXPECT_TRUE(mentions(problem({-0.5, 0.5, 0}, {1, 0.5, 0}),
                       {"crack.from", "(-0.5, 0.5) m", "plate", "no particle", "1e-6 of the spacing", "(0, 0.5) m"}));
  EXPECT_EQ(
      problem({0, 0.5, 0}, {1.1, 0.5, 0}),
      "crack.to is (1.1, 0.5) m, where body \"plate\" has no particle (allowed: the place of one, within 1e-6 of the "
      "spacing) - the nearest is at (1, 0.5) m");
  EXPECT_TRUE(mentions(problem({0, 0.5, 0}, {0.25, 0.5, 0}), {"plate", "2 particles", "3 or more", "longer"}));
  EXPECT_TRUE(mentions(problem({0, 0, 0}, {1, 0.5, 0}), {"plate", "no particle between (0, 0) m and (0.5, 0.25) m",
                                                         "row", "corner to corner", "remove the jitter"}));
  EXPECT_TRUE(mentions(problem({0, 1, 0}, {2, 1, 0}), {"plate", "boundary", "inside", "move"}));
  ShapeSpec shaken = plate();
  shaken.jitter = 0.1;
  EXPECT_TRUE(
      mentions(problem({0, 0.5, 0}, {2, 0.5, 0}, shaken), {"plate", "no particle between (0, 0.5) m and (2, 0.5) m"}));
  ParticleSet set = filled();
  EXPECT_THROW(open_crack(set, 0, {0, 0, 0}, {1, 0.5, 0}), InputError);
  EXPECT_TRUE(set.cracks.empty());
}

TEST(Crack, CracksStayApart) {
  ParticleSet set = filled();
  open_crack(set, 0, {0.5, 0.5, 0}, {1.5, 0.5, 0});
  auto const why = [&](Vec3 const& from, Vec3 const& to) { return trace_crack(set, 0, from, to).problem; };
  test::KeyWords const touches{"plate", "meets the crack from (0.5, 0.5) m to (1.5, 0.5) m", "apart", "move one"};
  EXPECT_TRUE(mentions(why({1, 0, 0}, {1, 1, 0}), touches));        // across
  EXPECT_TRUE(mentions(why({1.5, 0, 0}, {1.5, 0.5, 0}), touches));  // tip to tip
  EXPECT_TRUE(mentions(why({2, 0.5, 0}, {1.5, 0.5, 0}), touches));  // one goes on where the other ends
  EXPECT_TRUE(mentions(why({0.75, 0.5, 0}, {1.25, 0.5, 0}), touches));
  EXPECT_TRUE(mentions(why({0, 0.5, 0}, {2, 0.5, 0}), touches));
  EXPECT_EQ(why({0.25, 0.75, 0}, {1.75, 0.75, 0}), "");
  EXPECT_EQ(why({1.75, 0.25, 0}, {1.75, 0.75, 0}), "");
}

// Diagonals of the same cell share no particle.
TEST(Crack, CracksThatCrossInTheMiddleOfACellMeet) {
  ParticleSet set = filled();
  open_crack(set, 0, {0.25, 0.25, 0}, {0.75, 0.75, 0});
  EXPECT_NE(trace_crack(set, 0, {0, 0.75, 0}, {0.75, 0, 0}).problem, "");
  EXPECT_NE(trace_crack(set, 0, {0.25, 0.5, 0}, {0.75, 0, 0}).problem, "");
  EXPECT_EQ(trace_crack(set, 0, {1, 1, 0}, {1.5, 0.5, 0}).problem, "");
}

}  // namespace
}  // namespace piola
