// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/clusters.hpp"
#include "support/placed.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <random>

namespace piola {
namespace {

using testing::Places3;

double distance(std::array<double, 3> const& a, std::array<double, 3> const& b) {
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

Places3 off_lattice(std::size_t count) {
  std::mt19937 random(7);
  Places3 points(count);
  for (auto& p : points)
    for (double& c : p) c = 8e-6 * static_cast<double>(random() % 1000000);
  return points;
}

TEST(Clusters, HangTogetherByLinksShorterThanTheLimit) {
  Places3 const points{{4, 0, 0}, {0, 0, 0}, {2, 0, 0}, {1, 0, 0}};
  Clusters const loose = find_clusters(points, 1.5);
  EXPECT_EQ(loose.of, (std::vector<std::size_t>{0, 1, 1, 1}));
  EXPECT_EQ(loose.size, (std::vector<std::size_t>{1, 3}));
  EXPECT_EQ(find_clusters(points, 1).size.size(), 4u);
  EXPECT_EQ(find_clusters(points, 2.01).size.size(), 1u);
  EXPECT_TRUE(find_clusters({}, 1).size.empty());
}

// Labels spread from the first point of each cluster by brute force.
TEST(Clusters, AreThoseOfASearchThroughAllPairs) {
  Places3 const points = off_lattice(400);
  double const link = 0.8;
  std::vector<std::size_t> of(points.size(), points.size());
  std::size_t count = 0;
  for (std::size_t first = 0; first < points.size(); ++first) {
    if (of[first] < points.size()) continue;
    std::vector<std::size_t> front{first};
    of[first] = count;
    while (!front.empty()) {
      std::size_t const i = front.back();
      front.pop_back();
      for (std::size_t j = 0; j < points.size(); ++j) {
        if (of[j] < points.size() || distance(points[i], points[j]) >= link) continue;
        of[j] = count;
        front.push_back(j);
      }
    }
    ++count;
  }
  EXPECT_EQ(find_clusters(points, link).of, of);
  EXPECT_GT(count, 20u);
  EXPECT_LT(count, 350u);
}

TEST(Clusters, NearestDistancesAreThoseOfASearchThroughAllPairs) {
  Places3 points = off_lattice(300);
  points.push_back({90, -20, 4});
  std::vector<std::size_t> of(points.size());
  std::iota(of.begin(), of.end(), std::size_t{0});
  auto const found = nearest_distances(points, of, 0.3);
  for (std::size_t const i : of) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < points.size(); ++j)
      if (j != i) least = std::min(least, distance(points[i], points[j]));
    EXPECT_DOUBLE_EQ(found[i], least) << i;
  }
}

TEST(Clusters, ASinglePointHasNoNeighbour) {
  std::vector<std::size_t> const of{0};
  EXPECT_TRUE(std::isinf(nearest_distances({{1, 2, 3}}, of, 1).at(0)));
}

TEST(Clusters, ParticlesThatWentAstrayAreLeftOut) {
  auto const set = testing::make_row(3);
  testing::Placed const placed(set, {{0, 1, 0}, {std::nan(""), 0, 0}, {5, 0, 0}});
  FieldCache cache(placed, set);
  Cloud const cloud = cloud_of(cache, std::vector<std::int64_t>{0, 1, 2});
  EXPECT_EQ(cloud.id, (std::vector<std::int64_t>{0, 2}));
  EXPECT_EQ(cloud.x, (Places3{{0, 1, 0}, {5, 0, 0}}));
}

}  // namespace
}  // namespace piola
