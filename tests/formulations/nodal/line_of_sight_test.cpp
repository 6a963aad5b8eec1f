// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/line_of_sight.hpp"
#include "formulations/nodal/nodal_bodies.hpp"

namespace piola::testing {
namespace {

using Distance = std::function<double(Point const&)>;

/// Whether two places of a plane body with this distance from its surface see each other [m].
bool see(Distance const& distance, Point const& a, Point const& b) {
  ParticleSet set = brick(2);
  set.bodies[0].outline.distance = distance;
  SlotOrder const order = nodal::slot_order(set, set.bodies[0]);
  std::vector<double> const densities{1000};
  Assembly const none;
  nodal::SetUp const from{set,           set.bodies[0], order, none.loads,
                          none.supports, densities,     0.3,   *nodal::find_backend("auto")};
  std::vector<Point> const X{a, b};
  nodal::LineOfSight const line(from, X, {1, 1, 1});
  EXPECT_EQ(line.is_blocked(0, 1), line.is_blocked(1, 0));
  return !line.is_blocked(0, 1);
}

TEST(LineOfSight, DoesNotCrossASlitHoweverNarrow) {
  for (double const width : {0.1, 0.5, 1.0}) {
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

TEST(LineOfSight, GrazesAHollowSurface) {
  Distance const hole = [](Point const& X) { return 5 - std::hypot(X[0], X[1]); };
  EXPECT_TRUE(see(hole, {5, -0.9, 0}, {5, 0.9, 0})) << "inside";
  EXPECT_TRUE(see(hole, {4.9, -1, 0}, {4.9, 1, 0})) << "a tenth outside over its length of two";
  EXPECT_FALSE(see(hole, {-5.2, 0, 0}, {5.2, 0, 0})) << "across the hole";
}

TEST(LineOfSight, SeesEverythingWhereDistancesAreNotKnown) { EXPECT_TRUE(see({}, {0, 0, 0}, {2, 0, 0})); }

}  // namespace
}  // namespace piola::testing
