// SPDX-License-Identifier: Apache-2.0
#include "mesh_shapes.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <thread>

namespace piola {
namespace {

using namespace geometry;
using namespace testing;

SolidPtr good_solid(Shape const& shape) {
  MeshReport report;
  SolidPtr solid = solid_of(shape, report);
  EXPECT_EQ(all_of(report.problems), "");
  return solid;
}

std::vector<Vec<3>> places_around(double reach, int count) {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> value(-reach, reach);
  std::vector<Vec<3>> places(count);
  for (auto& X : places) X = {{0.5 + value(generator), 0.5 + value(generator), 0.5 + value(generator)}};
  return places;
}

double distance_to_unit_cube(Vec<3> const& X) {
  double inside = -1e300, outside = 0;
  for (int i = 0; i < 3; ++i) {
    double const q = std::abs(X[i] - 0.5) - 0.5;
    inside = std::max(inside, q);
    outside += std::max(q, 0.0) * std::max(q, 0.0);
  }
  return inside < 0 ? inside : std::sqrt(outside);
}

TEST(MeshDistance, OfACubeIsExactInsideOutsideAndFarAway) {
  auto const solid = good_solid(unit_cube());
  for (double const reach : {0.5, 0.7, 3.0, 300.0, 3e6})
    for (Vec<3> const& X : places_around(reach, 500))
      EXPECT_NEAR(solid->at(X).distance, distance_to_unit_cube(X), 4e-16 * (1 + reach));
}

TEST(MeshDistance, OfACubeIsExactAboveItsCornersEdgesAndFaces) {
  auto const solid = good_solid(unit_cube());
  for (double const a : {-1.0, -1e-3, 0.0, 0.5, 1.0, 1.001, 2.0})
    for (double const b : {-1.0, -1e-9, 0.0, 0.25, 1.0, 2.0})
      for (double const c : {-1.0, 0.0, 0.5, 1.0, 2.0}) {
        Vec<3> const X{{a, b, c}};
        Foot const foot = solid->at(X);
        EXPECT_NEAR(foot.distance, distance_to_unit_cube(X), 1e-15) << a << " " << b << " " << c;
        EXPECT_NEAR(dot(foot.normal, foot.normal), 1, 1e-14);
        Vec<3> const on = X - foot.distance * foot.normal;
        EXPECT_NEAR(distance_to_unit_cube(on), 0, 1e-14) << a << " " << b << " " << c;
      }
}

TEST(MeshDistance, TellsTheSideOfSharpEdgesAndCorners) {
  auto const solid = good_solid(corner_tetrahedron());
  // The inside is where all four of these are negative; the distance inside is to the nearest plane.
  auto const largest_plane = [](Vec<3> const& X) {
    return std::max({-X[0], -X[1], -X[2], (X[0] + X[1] + X[2] - 1) / std::sqrt(3.0)});
  };
  for (Vec<3> const& X : places_around(1.5, 3000)) {
    double const plane = largest_plane(X), d = solid->at(X).distance;
    EXPECT_EQ(d < 0, plane < 0);
    if (plane < 0) {
      EXPECT_NEAR(d, plane, 1e-15);
    } else {
      EXPECT_GE(d, plane - 1e-15);
    }
  }
}

TEST(MeshDistance, NormalIsItsGradient) {
  auto const solid = good_solid(round_ball(2));
  for (Vec<3> const& X : places_around(1.2, 200)) {
    Foot const foot = solid->at(X);
    double const h = 1e-7;
    EXPECT_NEAR((solid->at(X + h * foot.normal).distance - foot.distance) / h, 1, 1e-6);
  }
}

TEST(MeshDistance, OfABallIsTheOneToTheNearestOfAllFaces) {
  Shape const ball = round_ball(4);
  auto const solid = good_solid(ball);
  for (Vec<3> const& X : places_around(2, 300)) {
    double const to_centre = std::sqrt(dot(X, X)), d = solid->at(X).distance;
    EXPECT_GE(d, to_centre - 1 - 1e-7);             // the mesh lies inside the sphere, to single precision ...
    EXPECT_LE(d, to_centre - 1 + 0.5 * 0.1 * 0.1);  // ... by less than the height of its arcs, edges being 0.1 long
  }
}

TEST(MeshDistance, IsTheSameInAllThreads) {
  auto const solid = good_solid(round_ball(4));
  auto const places = places_around(2, 4000);
  auto const all = [&] {
    std::vector<double> values;
    for (Vec<3> const& X : places) {
      Foot const foot = solid->at(X);
      values.insert(values.end(), {foot.distance, foot.normal[0], foot.normal[1], foot.normal[2]});
    }
    return values;
  };
  auto const alone = all();
  std::vector<std::vector<double>> together(4);
  std::vector<std::thread> threads;
  for (auto& values : together) threads.emplace_back([&] { values = all(); });
  for (auto& thread : threads) thread.join();
  for (auto const& values : together) EXPECT_EQ(values, alone);
}

TEST(MeshDistance, DoesNotDependOnTheOrderOfTheFaces) {
  Shape const ball = round_ball(3);
  Shape turned = ball;
  std::reverse(turned.face.begin(), turned.face.end());
  auto const one = good_solid(ball), other = good_solid(turned);
  for (Vec<3> const& X : places_around(2, 500)) EXPECT_EQ(one->at(X).distance, other->at(X).distance);
}

TEST(MeshDistance, SeesFacesWithoutAreaThrough) {
  // The top of a cube whose edge is split on one side only; a flat face fills the gap.
  Shape cube = unit_cube();
  cube.X.push_back({{0.5, 0, 1}});
  for (auto& f : cube.face)
    if (f == std::array{4, 5, 7}) f = {4, 8, 7};
  cube.face.push_back({8, 5, 7});
  cube.face.push_back({4, 5, 8});
  auto const solid = good_solid(cube);
  for (Vec<3> const& X : places_around(1, 2000)) EXPECT_NEAR(solid->at(X).distance, distance_to_unit_cube(X), 1e-15);
}

TEST(MeshDistance, IsNegativeBetweenTheShellsOfAHollowBody) {
  Shape hollow = unit_cube();
  hollow.add(cuboid({{0.25, 0.25, 0.25}}, {{0.75, 0.75, 0.75}}).turn());
  auto const solid = good_solid(hollow);
  EXPECT_NEAR(solid->at({{0.5, 0.5, 0.5}}).distance, 0.25, 1e-15);
  EXPECT_NEAR(solid->at({{0.5, 0.5, 0.125}}).distance, -0.125, 1e-15);
  EXPECT_NEAR(*solid->exact_volume(), 1 - 0.125, 1e-14);
}

}  // namespace
}  // namespace piola
