// SPDX-License-Identifier: Apache-2.0
#include "piola/particles/ordering.hpp"
#include "particles/lattices.hpp"
#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <vector>

namespace piola {
namespace {

void expect_permutation_and_padding(ParticleSet const& set, Body const& body) {
  SlotOrder const order = pencil_order(set, body);
  EXPECT_EQ(order.particles, body.last - body.first);
  EXPECT_EQ(order.slots() % SlotOrder::alignment, 0);
  EXPECT_GE(order.slots(), order.particles);
  EXPECT_LT(order.slots() - order.particles, SlotOrder::alignment);
  std::vector<std::int64_t> ids(order.id.begin(), order.id.begin() + order.particles);
  std::sort(ids.begin(), ids.end());
  for (std::size_t k = 0; k < ids.size(); ++k) EXPECT_EQ(ids[k], body.first + static_cast<std::int64_t>(k));
  for (Index s = order.particles; s < order.slots(); ++s)
    EXPECT_EQ(order.id[static_cast<std::size_t>(s)], SlotOrder::no_particle);
}

TEST(PencilOrder, HoldsEveryParticleOnceAndFillsUpWithEmptySlots) {
  for (int dimension = 1; dimension <= 3; ++dimension)
    for (int const n : {2, 4, 11}) {
      ParticleSet const set = testing::unit_box(dimension, n);
      expect_permutation_and_padding(set, set.bodies[0]);
    }
  ParticleSet const jittered = testing::unit_box(3, 7, 0.2);
  expect_permutation_and_padding(jittered, jittered.bodies[0]);
}

TEST(PencilOrder, OfASecondBodyHoldsItsOwnParticlesOnly) {
  ParticleSet set = testing::unit_box(3, 4);
  ShapeSpec ball;
  ball.kind = ShapeSpec::Kind::sphere;
  ball.centre = {5, 0, 0};
  ball.radius = 1;
  ball.spacing = 0.3;
  fill(ball, "ball", set);
  expect_permutation_and_padding(set, set.bodies[1]);
}

TEST(PencilOrder, KeepsRowsAlongTheLongestDirectionWhole) {
  ParticleSet const set = testing::box({1, 6, 1}, {5, 25, 5});
  SlotOrder const order = pencil_order(set, set.bodies[0]);
  for (std::size_t s = 0; s < 625; ++s) {
    auto const& at = set.lattice_index[static_cast<std::size_t>(order.id[s])];
    EXPECT_EQ(at[1], static_cast<int>(s % 25));
  }
}

TEST(PencilOrder, ComesInPencilsOfEightByEightRows) {
  ParticleSet const set = testing::box({2, 1, 1}, {40, 20, 20});
  SlotOrder const order = pencil_order(set, set.bodies[0]);
  std::size_t const pencil = 8 * 8 * 40;
  for (std::size_t s = 0; s < pencil; ++s) {
    auto const& at = set.lattice_index[static_cast<std::size_t>(order.id[s])];
    EXPECT_LT(at[1], 8);
    EXPECT_LT(at[2], 8);
  }
}

/// The order as it is defined, by comparison.
std::vector<std::int64_t> sorted_pencils(ParticleSet const& set, Body const& body) {
  auto const longest =
      static_cast<std::size_t>(std::max_element(body.lattice.begin(), body.lattice.end()) - body.lattice.begin());
  std::array<std::size_t, 3> const axis{longest, longest == 0 ? 1U : 0U, longest == 2 ? 1U : 2U};
  std::vector<std::int64_t> ids;
  for (auto id = body.first; id < body.last; ++id) ids.push_back(id);
  auto const key = [&](std::int64_t id) {
    auto const& at = set.lattice_index[static_cast<std::size_t>(id)];
    int const x = at[axis[0]], y = at[axis[1]], z = at[axis[2]];
    return std::array{std::int64_t{z} / 8, std::int64_t{y} / 8, std::int64_t{z}, std::int64_t{y}, std::int64_t{x}, id};
  };
  std::sort(ids.begin(), ids.end(), [&](auto a, auto b) { return key(a) < key(b); });
  return ids;
}

// Rows along any axis, of different lengths, and lattice indices that several particles have.
TEST(PencilOrder, IsThatOfASortByPencilRowPlaceAndId) {
  ParticleSet set = testing::box({1, 6, 1}, {5, 25, 17});
  ShapeSpec ball;
  ball.kind = ShapeSpec::Kind::sphere;
  ball.radius = 1;
  ball.spacing = 0.1;
  fill(ball, "ball", set);
  ShapeSpec disc = ball;
  disc.dimension = 2;
  disc.arrangement = ShapeSpec::Arrangement::rings;
  ParticleSet rings;
  fill(disc, "disc", rings);
  for (ParticleSet const* all : {&set, &rings})
    for (Body const& body : all->bodies) {
      SlotOrder const order = pencil_order(*all, body);
      EXPECT_EQ(std::vector(order.id.begin(), order.id.begin() + order.particles), sorted_pencils(*all, body))
          << body.name;
    }
}

}  // namespace
}  // namespace piola
