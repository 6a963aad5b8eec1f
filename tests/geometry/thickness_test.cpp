// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/thickness.hpp"
#include "piola/geometry/boolean_solid.hpp"
#include "piola/geometry/primitives.hpp"
#include "exec/thread_count.hpp"
#include <gtest/gtest.h>

using namespace piola;
using namespace piola::geometry;

namespace {

double thickness(SolidPtr const& solid, double edge) {
  auto const found = thinnest(*solid, edge);
  return found ? found->thickness : -1;
}

TEST(Thickness, OfBodiesThatHaveOneIsExact) {
  EXPECT_NEAR(thickness(box({}, {{1, 2, 0.25}}, 3), 0.1), 0.25, 1e-12);
  EXPECT_NEAR(thickness(box({}, {{1, 0.03, 0}}, 2), 0.1), 0.03, 1e-12);
  EXPECT_NEAR(thickness(ball({}, 0.5, 0, 3), 0.1), 1, 1e-9);
  EXPECT_NEAR(thickness(ball({}, 1, 0.9, 2), 0.05), 0.1, 1e-9);
  EXPECT_NEAR(thickness(capsule({}, {{5, 0, 0}}, 0.05, 3), 0.1), 0.1, 1e-9);  // a needle
  EXPECT_NEAR(thickness(torus({}, {{0, 0, 1}}, 1, 0.2), 0.1), 0.4, 1e-9);
}

/// The piece nearest to the tip is within an edge of it, where the cone is 2 tan(alpha) thick per length.
TEST(Thickness, OfASlenderTipEndsWithTheLastPiece) {
  double const edge = 0.05, found = thickness(cone({}, {{1, 0, 0}}, 4, 0.4, 0), edge);
  EXPECT_GT(found, 0);
  EXPECT_LT(found, 0.25 * edge);
}

TEST(Thickness, IsThatOfTheThinnestPart) {
  SolidPtr const plate = box({}, {{2, 2, 0.5}}, 3), rib = box({{0.9, 0, 0.5}}, {{1, 2, 1.5}}, 3);
  auto const found = thinnest(*combined(BooleanOperation::join, {plate, rib}), 0.1);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->thickness, 0.1, 1e-9);
  EXPECT_NEAR(found->X[0], 0.95, 1e-9);
  // What a bore leaves of a plate: a web of 0.06.
  SolidPtr const bored =
      combined(BooleanOperation::cut, {box({}, {{2, 2, 0.5}}, 3), cylinder({{1, 0.46, -1}}, {{0, 0, 1}}, 3, 0.4, 0)});
  EXPECT_NEAR(thickness(bored, 0.05), 0.06, 0.005);
}

TEST(Thickness, DoesNotDependOnThreads) {
  SolidPtr const solid = torus({}, {{0, 0.6, 0.8}}, 1, 0.3);
  std::optional<Thinnest> one, other;
  {
    piola::testing::Threads const threads(1);
    one = thinnest(*solid, 0.03);
  }
  {
    piola::testing::Threads const threads(3);
    other = thinnest(*solid, 0.03);
  }
  ASSERT_TRUE(one && other);
  EXPECT_EQ(one->thickness, other->thickness);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(one->X[c], other->X[c]);
}

}  // namespace
