// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/neighbours/delaunay_hull.hpp"
#include "piola/neighbours/mesh_cells.hpp"
#include "piola/neighbours/simplex.hpp"
#include "neighbours/cell_checks.hpp"
#include "support/key_words.hpp"
#include <limits>

namespace piola {
namespace {

using namespace testing;
using test::mentions;

Points random_points(std::size_t count, int dimension, std::uint32_t seed) {
  Random random(seed);
  Points points(count);
  for (auto& p : points)
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) p[d] = random.in(0, 1);
  return points;
}

/// Turned about z (2D) or an oblique axis, and moved away from the origin.
Points turned(Points points, int dimension) {
  Mat<3> const Q = rotation_about(dimension == 2 ? Vec<3>{{0, 0, 1}} : Vec<3>{{1, 2, 3}}, 0.7);
  for (auto& p : points)
    p = {3 + Q(0, 0) * p[0] + Q(0, 1) * p[1] + Q(0, 2) * p[2], -1 + Q(1, 0) * p[0] + Q(1, 1) * p[1] + Q(1, 2) * p[2],
         dimension == 2 ? 0 : Q(2, 0) * p[0] + Q(2, 1) * p[1] + Q(2, 2) * p[2]};
  return points;
}

std::string message(Points const& points, int dimension) {
  try {
    delaunay(points, dimension, 1);
  } catch (InputError const& error) {
    return error.what();
  }
  return "nothing is wrong";
}

TEST(Delaunay, FillsLatticesHoweverRegularTheyAre) {
  for (int const dimension : {2, 3})
    for (double const jitter : {0.0, 1e-9, 1e-7, 1e-5, 1e-3, 0.1, 0.3})
      for (bool const turn : {false, true}) {
        SCOPED_TRACE(std::to_string(dimension) + "D, jitter " + std::to_string(jitter) + (turn ? ", turned" : ""));
        int const n = dimension == 2 ? 30 : 11;
        Points points = unit_box(dimension, n, jitter).X;
        if (turn) points = turned(points, dimension);
        expect_filled(delaunay(points, dimension, 1.5 / (n - 1)), points, 1, 2 * dimension);
      }
}

TEST(Delaunay, ARegularLatticeHasNoSliversInside) {
  Points const points = turned(unit_box(3, 9).X, 3);
  EXPECT_NEAR(smallest_volume(delaunay(points, 3, 0.2), points), 1.0 / 512 / 6, 1e-12);
  Points const plate = turned(unit_box(2, 9).X, 2);
  EXPECT_EQ(delaunay(plate, 2, 0.2).count(), 128);
}

TEST(Delaunay, FillsThinBodies) {
  Points const bar = turned(box({10, 0.1, 0}, {401, 5, 1}, 2).X, 2);
  expect_filled(delaunay(bar, 2, 0.03), bar, 1, 20.2);
  Points const sheet = turned(box({1, 1, 0.05}, {21, 21, 2}).X, 3);
  expect_filled(delaunay(sheet, 3, 0.06), sheet, 0.05, 2.2);
}

/// The circle through the corners of a cell has them at one distance and no other point inside.
void expect_empty_circle(Cells const& cells, Index cell, Points const& points) {
  auto const corner = cells.of(cell);
  Vec<3> const centre = vector(at(points, corner[0])) + circumcentre(points, corner.data(), cells.dimension);
  double const r = circumradius(points, corner.data(), cells.dimension);
  for (Index p = 0; p < std::ssize(points); ++p) {
    Vec<3> const away = vector(at(points, p)) - centre;
    double const distance = std::sqrt(dot(away, away));
    if (std::find(corner.begin(), corner.end(), p) != corner.end())
      EXPECT_NEAR(distance, r, 1e-9 * r);
    else
      EXPECT_GT(distance, r - 1e-7);
  }
}

TEST(Delaunay, EveryCircleThroughCornersIsEmpty) {
  for (int const dimension : {2, 3}) {
    Points const points = random_points(200, dimension, 5);
    Cells const cells = delaunay(points, dimension, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(enclosed_volume(surface_of(cells, points), points), total_volume(cells, points), 1e-12);
    EXPECT_GT(total_volume(cells, points), dimension == 2 ? 0.92 : 0.75);
    EXPECT_GT(smallest_volume(cells, points), 0);
    for (Index cell = 0; cell < cells.count(); ++cell) expect_empty_circle(cells, cell, points);
  }
}

TEST(Delaunay, TheSamePointsGiveTheSameCells) {
  for (int const dimension : {2, 3}) {
    Points const points = unit_box(dimension, 8).X;
    Cells const cells = delaunay(points, dimension, 0.2);
    EXPECT_EQ(delaunay(points, dimension, 0.2).corner, cells.corner);
    // Moved and turned as a rigid body, they keep their diagonals.
    EXPECT_EQ(delaunay(turned(points, dimension), dimension, 0.2).corner, cells.corner);
  }
}

TEST(Delaunay, DoesNotDependOnTheUnitOfLength) {
  Points points = random_points(300, 2, 7);
  Cells const cells = delaunay(points, 2, 0.1);
  for (auto& p : points) p = {p[0] * 0x1p-30, p[1] * 0x1p-30, 0};
  EXPECT_EQ(delaunay(points, 2, 0.1 * 0x1p-30).corner, cells.corner);
}

// A lattice does not tell whether the body goes across an inner corner: the half box between its three points is a
// triangle like all others.
TEST(Delaunay, LeavesOutNotchesAndHolesButForTheirCorners) {
  double const h = 0.1, half = h * h / 2, shortcut = (std::sqrt(2.0) - 2) * h;
  for (bool const turn : {false, true}) {
    auto const placed = [&](ParticleSet const& set) { return turn ? turned(set.X, 2) : set.X.seen(); };
    Points const angle = placed(part_of(unit_box(2, 11), [](auto const& X) { return X[0] < 0.45 || X[1] < 0.35; }));
    expect_filled(delaunay(angle, 2, 0.09), angle, 1 - 0.6 * 0.7 + half, 4 + shortcut);
    Points const plate = placed(part_of(
        unit_box(2, 11), [](auto const& X) { return std::max(std::fabs(X[0] - 0.5), std::fabs(X[1] - 0.5)) > 0.15; }));
    expect_filled(delaunay(plate, 2, 0.09), plate, 1 - 0.16 + 4 * half, 5.6 + 4 * shortcut);
    EXPECT_EQ(pieces(surface_of(delaunay(plate, 2, 0.09), plate), plate), 2);
  }
}

// A hole of 2 x 2 x 2 points: the boxes at its corners lack one particle, those along its edges two.
TEST(Delaunay, LeavesAHoleInABlock) {
  double const h = 1.0 / 7;
  Points const block = part_of(unit_box(3, 8), [](auto const& X) {
                         return std::max({std::fabs(X[0] - 0.5), std::fabs(X[1] - 0.5), std::fabs(X[2] - 0.5)}) > 0.1;
                       }).X;
  double const hole = 27 - 8 * 5.0 / 6 - 12 * 0.5, inside = 6 + 12 * std::sqrt(2.0) + 8 * std::sqrt(3.0) / 2;
  Cells const cells = delaunay(block, 3, 0.9 * h);
  expect_filled(cells, block, 1 - hole * h * h * h, 6 + inside * h * h);
  EXPECT_EQ(pieces(surface_of(cells, block), block), 2);
}

TEST(Delaunay, KeepsSeparatePiecesApart) {
  for (int const dimension : {2, 3}) {
    Points points = unit_box(dimension, 9).X;
    std::size_t const half = points.size();
    points.insert(points.end(), points.begin(), points.begin() + static_cast<std::ptrdiff_t>(half));
    for (std::size_t p = half; p < points.size(); ++p) points[p][0] += 1.3;
    Cells const cells = delaunay(points, dimension, 0.14);
    expect_filled(cells, points, 2, 4 * dimension);
    EXPECT_EQ(pieces(surface_of(cells, points), points), 2);
  }
}

TEST(Delaunay, AlongALineIsTheIntervalsThatAreNotTooLong) {
  Points const points{{0.3, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0.1, 0, 0}, {1.2, 0, 0}};
  Cells const cells = delaunay(points, 1, 0.11);
  EXPECT_EQ(cells.corner, (std::vector<Index>{1, 3, 3, 0, 2, 4}));
  Surface const surface = surface_of(cells, points);
  EXPECT_EQ(surface.corner, (std::vector<Index>{1, 0, 2, 4}));
  EXPECT_EQ(surface.outward, (std::vector<double>{-1, 1, -1, 1}));
}

TEST(Delaunay, OfOneSimplexIsThisSimplex) {
  EXPECT_EQ(delaunay({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}, 2, 1).corner, (std::vector<Index>{0, 2, 1}));
  EXPECT_EQ(delaunay({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}, 3, 1).corner, (std::vector<Index>{0, 1, 3, 2}));
}

TEST(Delaunay, RefusesPointsWithoutCellsInWords) {
  EXPECT_TRUE(mentions(message({{0, 0, 0}, {1, 0, 0}}, 2),
                       {"cells between points", "only 2 points", "at least 3 in 2D", "more particles"}));
  EXPECT_TRUE(mentions(message({{1, 0, 0}}, 1),
                       {"cells between points", "only 1 point", "at least 2 in 1D", "more particles"}));
  EXPECT_TRUE(
      mentions(message({}, 3), {"cells between points", "only 0 points", "at least 4 in 3D", "more particles"}));
  EXPECT_TRUE(mentions(message({{0, 0, 0}, {1, 0.1, 0}, {2, 0.2, 0}, {3, 0.3, 0}}, 2),
                       {"cells between points", "all 4 points", "one line", "1D", "second layer"}));
  EXPECT_TRUE(mentions(message(turned(box({1, 1, 0}, {5, 5, 1}, 2).X, 3), 3),
                       {"cells between points", "all 25 points", "one plane", "2D", "second layer"}));
  Points points = unit_box(2, 5).X;
  points.push_back(points[7]);
  points.push_back({points[7][0] + 0.5e-9, points[7][1], 0});
  points.push_back(points[3]);
  EXPECT_EQ(message(points, 2),
            "cells between points: 3 points of 28 at the place of another one, the first ones are numbers 3 and 27 at "
            "(0.75, 0) (points must be 1e-9 of their extent apart) - leave one of them out");
  points[9][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(mentions(message(points, 2), {"cells between points", "1 point without a finite position", "number 9",
                                            "finite", "what moved it"}));
}

TEST(Delaunay, TakesPointsThatNearlyCoincideOrLieNearlyOnALine) {
  Points points = unit_box(2, 5).X;
  points.push_back({points[7][0] + 1e-8, points[7][1] + 1e-8, 0});
  expect_filled(delaunay(points, 2, 0.3), points, 1, 4);
  points = {{0, 0, 0}, {1, 1e-6, 0}, {2, 0, 0}, {1, 1, 0}};
  EXPECT_NEAR(total_volume(delaunay(points, 2, 2), points), 1, 1e-5);
}

TEST(LowerHull, SaysWhatQhullSaysAndPrintsNothing) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  Points const line(10, {1, 2, 3});
  LowerHull const hull = lower_hull(line, std::vector<double>(10, 1.0), 2);
  Points const points = unit_box(3, 4).X;
  delaunay(points, 3, 1);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_TRUE(hull.corner.empty());
  EXPECT_NE(hull.trouble.find("QH6"), std::string::npos) << hull.trouble;
}

// All points of a lattice lifted exactly: every box is one facet with all its corners.
TEST(LowerHull, CutsFacetsWithManyCornersSoThatTheyFit) {
  Points const points = unit_box(2, 6).X;
  std::vector<double> height;
  for (auto const& p : points) height.push_back(p[0] * p[0] + p[1] * p[1]);
  LowerHull const hull = lower_hull(points, height, 2);
  double sum = 0;
  ASSERT_EQ(hull.corner.size(), 3U * 50);
  for (std::size_t k = 0; k < hull.corner.size(); k += 3) sum += std::fabs(simplex_volume(points, &hull.corner[k], 2));
  EXPECT_NEAR(sum, 1, 1e-14);
}

}  // namespace
}  // namespace piola
