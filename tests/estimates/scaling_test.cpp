// SPDX-License-Identifier: Apache-2.0
#include "piola/estimates/scaling.hpp"
#include "piola/setup/shapes.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

ParticleSet block(std::array<int, 3> const& n) {
  ShapeSpec box;
  box.kind = ShapeSpec::Kind::box;
  box.dimension = 3;
  for (std::size_t c = 0; c < 3; ++c) {
    box.particles[c] = n[c];
    box.max[c] = n[c] - 1;
  }
  ParticleSet set;
  fill(box, "block", set);
  return set;
}

Estimate cost_of(ParticleSet const& set) {
  Estimate e;
  e.step_work = 300e-9 * static_cast<double>(set.size());
  e.row_bytes = 200 * static_cast<double>(set.size());
  e.talk = {CommPattern{.messages = {{{2, 6}}, {{2, 12}}}, .stages = 1, .collectives = 5}};
  return e;
}

TEST(Scaling, OfOneRankIsTheRunItself) {
  ParticleSet const set = block({20, 20, 20});
  Scaling const s = scale(set, cost_of(set), 1);
  ASSERT_EQ(s.shares.size(), 1U);
  EXPECT_EQ(s.shares[0].particles, 8000);
  EXPECT_EQ(s.shares[0].halo, 0);
  EXPECT_EQ(s.shares[0].messages, 0);
  EXPECT_DOUBLE_EQ(s.efficiency, 1);
  EXPECT_DOUBLE_EQ(s.times.total(), 300e-9 * 8000);
}

TEST(Scaling, SharesOutAllParticlesAndCountsWhatTheySay) {
  // Rows of 32 along x, pencils of 8 x 8 rows: two of them, one per rank, that meet on a face of 32 x 8.
  ParticleSet const set = block({32, 16, 8});
  Scaling const s = scale(set, cost_of(set), 2);
  for (RankLoad const& share : s.shares) {
    EXPECT_EQ(share.particles, 2048);
    EXPECT_EQ(share.halo, 32 * 8);  // one layer: kernels of reach 2 vanish on the second one
    EXPECT_DOUBLE_EQ(share.messages, 2);
    EXPECT_DOUBLE_EQ(share.bytes, 32 * 8 * 18 * 8);
  }
  EXPECT_EQ(s.collectives, 6);
  EXPECT_LT(s.efficiency, 1);
}

TEST(Scaling, EndsWhereMessagesTakeAsLongAsSweeps) {
  ParticleSet const set = block({32, 16, 16});
  Estimate const cost = cost_of(set);
  Network slow;
  slow.latency = cost.step_work;  // one message is worth a step
  EXPECT_EQ(max_efficient_ranks(set, cost, 64, slow), 1);
  int const few = max_efficient_ranks(set, cost, 64), most = max_efficient_ranks(set, cost, 64, {0, 1e30, 0});
  EXPECT_GT(few, 1);
  EXPECT_EQ(most, 64);
  EXPECT_GE(scale(set, cost, few).efficiency, 0.5);
}

TEST(Scaling, IsOfBodiesThatAllSayWhatTheyTellEachOther) {
  Estimate cost;
  EXPECT_FALSE(runs_on_ranks(cost));
  cost.talk = {CommPattern{}, std::nullopt};
  EXPECT_FALSE(runs_on_ranks(cost));
  cost.talk = {CommPattern{}, CommPattern{}};
  EXPECT_TRUE(runs_on_ranks(cost));
}

}  // namespace
}  // namespace piola
