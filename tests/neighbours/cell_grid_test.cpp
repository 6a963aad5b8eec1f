// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/cell_grid.hpp"
#include "math/random.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

namespace piola {
namespace {

using Points = std::vector<std::array<double, 3>>;
using testing::Random;

std::vector<Index> within(CellGrid const& grid, Points const& points, std::array<double, 3> const& x, double radius) {
  std::vector<Index> found;
  grid.visit(x, [&](Index p) {
    double r2 = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      double const d = points[static_cast<std::size_t>(p)][c] - x[c];
      r2 += d * d;
    }
    if (r2 < radius * radius) found.push_back(p);
  });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<Index> one_by_one(Points const& points, std::array<double, 3> const& x, double radius) {
  std::vector<Index> found;
  for (std::size_t p = 0; p < points.size(); ++p) {
    double r2 = 0;
    for (std::size_t c = 0; c < 3; ++c) r2 += (points[p][c] - x[c]) * (points[p][c] - x[c]);
    if (r2 < radius * radius) found.push_back(static_cast<Index>(p));
  }
  return found;
}

/// Returns the number of neighbours found, so that a test can see that there were some.
std::size_t expect_all_found(Points const& points, double radius) {
  CellGrid const grid(points, radius);
  std::size_t count = 0;
  for (auto const& x : points) {
    auto const found = within(grid, points, x, radius);
    EXPECT_EQ(found, one_by_one(points, x, radius));
    count += found.size();
  }
  return count;
}

Points cloud(std::size_t n, double width, double height, std::uint32_t seed) {
  Random random(seed);
  Points points(n);
  for (auto& p : points) p = {random.in(-width, width), random.in(-width, width), random.in(-height, height)};
  return points;
}

TEST(CellGrid, FindsExactlyTheNeighboursOfRandomPoints) {
  EXPECT_GT(expect_all_found(cloud(500, 1, 1, 1), 0.3), 1000U);
}

TEST(CellGrid, FindsThemInAPlaneAndOnALine) {
  EXPECT_GT(expect_all_found(cloud(300, 1, 0, 2), 0.2), 600U);
  Points line(100);
  for (std::size_t k = 0; k < 100; ++k) line[k] = {0, 0.1 * static_cast<double>(k), 0};
  EXPECT_GT(expect_all_found(line, 0.25), 400U);
}

TEST(CellGrid, FindsThemInClustersFarApart) {
  Points points = cloud(200, 0.1, 0.1, 3);
  for (std::size_t k = 0; k < 200; k += 2) points[k][0] += 1e4;
  EXPECT_GT(expect_all_found(points, 0.05), 400U);
}

TEST(CellGrid, FindsThemAmongFewPointsInALargeSpace) {
  Points points = cloud(20, 1e6, 1e6, 4);
  points.push_back(points.back());
  points.back()[1] += 1e-3;
  EXPECT_EQ(expect_all_found(points, 1e-2), 23U);  // every point itself, and one pair
}

TEST(CellGrid, FindsPointsThatCoincide) {
  Points const points(5, {1, 2, 3});
  EXPECT_EQ(expect_all_found(points, 0.1), 25U);
}

TEST(CellGrid, OfNoPointsFindsNothing) {
  CellGrid const grid({}, 1);
  grid.visit({0, 0, 0}, [](Index) { ADD_FAILURE(); });
}

/// Number of points that visit() tries for all `places`: the cost of the grid.
std::size_t visits(CellGrid const& grid, Points const& places) {
  std::size_t count = 0;
  for (auto const& x : places) grid.visit(x, [&](Index) { ++count; });
  return count;
}

TEST(CellGrid, StaysFineBesidePointsFarAway) {
  Points points = cloud(2000, 1, 1, 6);
  std::size_t const alone = visits(CellGrid(points, 0.2), points);
  for (double const far : {1e3, 1e30, -1e30, 1e300}) {
    points.resize(2000);
    points.insert(points.begin(), {far, 0, 0});
    points.push_back({0, far, far});
    EXPECT_EQ(expect_all_found(points, 0.2), expect_all_found(Points(points.begin() + 1, points.end()), 0.2) + 1);
    EXPECT_LT(visits(CellGrid(points, 0.2), points), alone + alone / 2) << far;
  }
}

TEST(CellGrid, LeavesOutPointsWithoutAFinitePlace) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  Points const good = cloud(300, 1, 1, 7);
  for (double const bad : {infinity, -infinity, nan}) {
    Points points = good;
    points.push_back({0, bad, 0});
    points[0] = points[1] = {bad, bad, bad};
    CellGrid const grid(points, 0.3);
    std::vector<int> seen(points.size(), 0);
    for (auto const& x : points) grid.visit(x, [&](Index p) { ++seen[static_cast<std::size_t>(p)]; });
    for (std::size_t p = 0; p < points.size(); ++p) EXPECT_EQ(seen[p] == 0, p < 2 || p == 300) << p;
    for (std::size_t p = 2; p < 300; ++p)
      EXPECT_EQ(within(grid, points, points[p], 0.3), one_by_one(points, points[p], 0.3));
  }
}

TEST(CellGrid, TakesAnyWidthOfCells) {
  Points const points = cloud(50, 1, 1, 8);
  EXPECT_EQ(visits(CellGrid(points, 1e-9), points), 50U);
  EXPECT_EQ(visits(CellGrid(points, 1e300), points), 2500U);
  EXPECT_EQ(visits(CellGrid(points, std::numeric_limits<double>::infinity()), points), 2500U);
  for (double const cell : {0.0, 1e-300, 1e-30}) EXPECT_GE(visits(CellGrid(points, cell), points), 50U);
}

TEST(CellGrid, VisitsEachPointAtMostOnce) {
  Points const points = cloud(300, 1, 1, 5);
  for (double const cell : {0.4, 0.01}) {  // stored one after the other, and in a hash table
    CellGrid const grid(points, cell);
    for (auto const& x : points) {
      std::vector<int> seen(points.size(), 0);
      grid.visit(x, [&](Index p) { EXPECT_EQ(++seen[static_cast<std::size_t>(p)], 1); });
    }
  }
}

}  // namespace
}  // namespace piola
