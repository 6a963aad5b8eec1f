// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/cell_grid.hpp"
#include "math/random.hpp"
#include <algorithm>
#include <gtest/gtest.h>

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

TEST(CellGrid, VisitsEachPointAtMostOnce) {
  Points const points = cloud(300, 1, 1, 5);
  CellGrid const grid(points, 0.4);
  for (auto const& x : points) {
    std::vector<int> seen(points.size(), 0);
    grid.visit(x, [&](Index p) { EXPECT_EQ(++seen[static_cast<std::size_t>(p)], 1); });
  }
}

}  // namespace
}  // namespace piola
