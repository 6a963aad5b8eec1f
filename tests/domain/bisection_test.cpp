// SPDX-License-Identifier: Apache-2.0
#include "piola/domain/bisection.hpp"
#include "piola/domain/halo_plan.hpp"
#include "piola/exec/device_loops.hpp"
#include "particles/lattices.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <vector>

namespace piola {
namespace {

using Leaf = std::vector<std::int64_t>;

std::vector<Leaf> leaves_of(SlotOrder const& order) {
  std::vector<Leaf> leaves;
  for (auto k = order.id.begin(); k < order.id.end();) {
    auto const end = k + std::min<std::ptrdiff_t>(exec::leaf_size, order.id.end() - k);
    leaves.emplace_back(k, end);
    k = end;
  }
  return leaves;
}

/// Sums begin with leaves: the same ones wherever they stand, one that is not full at the end.
void expect_same_leaves(SlotOrder const& before, SlotOrder const& after) {
  EXPECT_EQ(after.particles, before.particles);
  auto old = leaves_of(before), now = leaves_of(after);
  ASSERT_EQ(now.size(), old.size());
  EXPECT_EQ(now.back(), old.back());
  std::sort(old.begin(), old.end());
  std::sort(now.begin(), now.end());
  EXPECT_EQ(now, old);
}

ParticleSet ball(double jitter) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::sphere;
  shape.radius = 1;
  shape.spacing = 0.09;
  shape.jitter = jitter;
  ParticleSet set;
  fill(shape, "ball", set);
  return set;
}

TEST(Bisection, MovesLeavesAsTheyAre) {
  ParticleSet const sets[] = {testing::box({1, 6, 1}, {5, 25, 17}), ball(0), ball(0.3), testing::unit_box(2, 37),
                              testing::unit_box(1, 500)};
  for (ParticleSet const& set : sets) {
    SlotOrder const order = pencil_order(set, set.bodies[0]);
    for (int const ranks : {1, 2, 3, 5, 8, 17}) expect_same_leaves(order, bisected(set, set.bodies[0], order, ranks));
  }
}

TEST(Bisection, LeavesTheOrderOfOneRank) {
  ParticleSet const set = ball(0);
  SlotOrder const order = pencil_order(set, set.bodies[0]);
  EXPECT_EQ(bisected(set, set.bodies[0], order, 1).id, order.id);
}

TEST(Bisection, KeepsTheOrderWithinAShare) {
  ParticleSet const set = testing::box({1, 1, 1}, {24, 24, 24});
  SlotOrder const order = pencil_order(set, set.bodies[0]);
  std::vector<Index> place(set.X.size());
  for (Index k = 0; k < order.particles; ++k)
    place[static_cast<std::size_t>(order.id[static_cast<std::size_t>(k)])] = k;
  SlotOrder const permuted = bisected(set, set.bodies[0], order, 4);
  for (int r = 0; r < 4; ++r) {
    Range const own = even_range_of_rank(permuted.slots(), r, 4);
    for (Index k = own.first + 1; k < own.last; ++k)
      EXPECT_LT(place[static_cast<std::size_t>(permuted.id[static_cast<std::size_t>(k - 1)])],
                place[static_cast<std::size_t>(permuted.id[static_cast<std::size_t>(k)])]);
  }
}

/// A share of a cube on four ranks is a quarter of its cross-section, along whole rows.
TEST(Bisection, QuartersTheCrossSectionOfACube) {
  ParticleSet const set = testing::box({1, 1, 1}, {32, 32, 32});
  SlotOrder const permuted = bisected(set, set.bodies[0], pencil_order(set, set.bodies[0]), 4);
  for (int r = 0; r < 4; ++r) {
    Range const own = even_range_of_rank(permuted.slots(), r, 4);
    std::set<std::pair<bool, bool>> quarters;
    for (Index k = own.first; k < own.last; ++k) {
      auto const& at = set.lattice_index[static_cast<std::size_t>(permuted.id[static_cast<std::size_t>(k)])];
      quarters.emplace(at[1] < 16, at[2] < 16);
    }
    EXPECT_EQ(quarters.size(), 1U) << "rank " << r;
  }
}

/// More ranks than leaves, and a body of less than one.
TEST(Bisection, OfFewLeaves) {
  for (int const n : {2, 3, 5}) {
    ParticleSet const set = testing::unit_box(3, n);
    SlotOrder const order = pencil_order(set, set.bodies[0]);
    expect_same_leaves(order, bisected(set, set.bodies[0], order, 7));
  }
}

}  // namespace
}  // namespace piola
