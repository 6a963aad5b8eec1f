// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/cloud_checks.hpp"
#include "particles/lattices.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

/// Around a corner of a cubic lattice, 17 places are within 2.4 spacings, itself included: |i|^2 <= 5 of i, j, k >= 0.
TEST(WorstNeighbourhood, OfALatticeIsACorner) {
  ParticleSet const set = testing::unit_box(3, 6);
  WorstNeighbourhood const worst = worst_neighbourhood(set, set.bodies[0]);
  EXPECT_EQ(worst.neighbours, 16);
  for (double const x : set.X[worst.point]) EXPECT_NEAR(std::abs(x - 0.5), 0.5, 0.1);
  EXPECT_GT(worst.part(), 0.1);
  EXPECT_LT(worst.part(), 0.5);
}

TEST(WorstNeighbourhood, IsWhereParticlesHaveBeenTakenAway) {
  ParticleSet set = testing::unit_box(2, 9);
  Body& body = set.bodies[0];
  body.last = body.first + 7 * 9 + 1;  // one is left alone on the eighth row
  WorstNeighbourhood const worst = worst_neighbourhood(set, body);
  EXPECT_EQ(worst.point, 63U);
  EXPECT_LT(worst.part(), 0.2);
}

}  // namespace
}  // namespace piola
