// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/line_of_sight.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace piola::testing {
namespace {

using Point = std::array<double, 3>;
using Distance = std::function<double(Point const&)>;

/// Whether two places see each other, with a spacing of 1 m and of 1 mm.
bool see(Distance const& distance, Point const& a, Point const& b) {
  LineOfSight const line(distance, 1);
  bool const blocked = line.is_blocked(a, b);
  EXPECT_EQ(line.is_blocked(b, a), blocked);
  if (!distance) return !blocked;
  constexpr double mm = 1e-3;
  auto const scaled = [](Point X, double by) {
    for (double& c : X) c *= by;
    return X;
  };
  LineOfSight const small([&](Point const& X) { return mm * distance(scaled(X, 1 / mm)); }, mm);
  EXPECT_EQ(small.is_blocked(scaled(a, mm), scaled(b, mm)), blocked);
  return !blocked;
}

TEST(LineOfSight, DoesNotCrossASlitHoweverNarrow) {
  for (double const width : {1e-5, 1e-3, 0.01, 0.03, 0.1, 0.5, 1.0}) {
    // A slit along x < 0; its sides are far from other surfaces.
    Distance const slit = [&](Point const& X) {
      double const across = 0.5 * width - std::fabs(X[1]);
      return X[0] < 0 ? std::max(across, -3.0) : across < 0 ? across : -std::max(X[0], 0.0);
    };
    EXPECT_FALSE(see(slit, {-2, 0.6, 0}, {-2, -0.6, 0})) << width;
    EXPECT_FALSE(see(slit, {-2, 0.6, 0}, {-1, -0.7, 0})) << width;
    EXPECT_TRUE(see(slit, {-2, 0.6, 0}, {-0.5, 0.6, 0})) << "on one side";
  }
}

/// Second neighbours of a lattice across a slit between its rows, of any width.
TEST(LineOfSight, DoesNotCrossASlitBetweenRowsOfALattice) {
  std::vector<double> widths{1e-5, 1e-4, 1e-3, 0.01, 0.02, 0.03, 0.04, 0.05, 0.07};
  for (double width = 0.1; width < 1; width += 0.02) widths.push_back(width);
  for (double const width : widths) {
    Distance const slit = [&](Point const& X) { return std::max(0.5 * width - std::fabs(X[1]), -3.0); };
    EXPECT_FALSE(see(slit, {0, 0.5, 0}, {2, -0.5, 0})) << width;
    EXPECT_FALSE(see(slit, {0, 0.5, 0}, {-2, -0.5, 0})) << width;
    EXPECT_FALSE(see(slit, {0, 0.5, 0}, {1, -0.5, 0})) << width;
  }
}

TEST(LineOfSight, GrazesAHollowSurface) {
  Distance const hole = [](Point const& X) { return 5 - std::hypot(X[0], X[1]); };
  EXPECT_TRUE(see(hole, {5, -0.9, 0}, {5, 0.9, 0})) << "inside";
  EXPECT_TRUE(see(hole, {4.9, -1, 0}, {4.9, 1, 0})) << "a tenth outside over its length of two";
  EXPECT_FALSE(see(hole, {-5.2, 0, 0}, {5.2, 0, 0})) << "across the hole";
}

TEST(LineOfSight, TouchesAReentrantEdge) {
  // Material but for the quarter x > 0, y > 0.
  Distance const corner = [](Point const& X) {
    return X[0] > 0 && X[1] > 0 ? std::min(X[0], X[1]) : -std::hypot(std::max(-X[0], 0.0), std::max(-X[1], 0.0));
  };
  EXPECT_TRUE(see(corner, {-0.5, 0.5, 0}, {0.5, -0.5, 0})) << "through the edge";
  EXPECT_TRUE(see(corner, {-1.5, 0.5, 0}, {1.5, -1.5, 0})) << "beside it";
  EXPECT_FALSE(see(corner, {-0.5, 1.5, 0}, {1.5, -0.5, 0})) << "outside";
}

TEST(LineOfSight, SeesEverythingWhereDistancesAreNotKnown) { EXPECT_TRUE(see({}, {0, 0, 0}, {2, 0, 0})); }

}  // namespace
}  // namespace piola::testing
