// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/particle_cells.hpp"
#include "piola/geometry/boolean_solid.hpp"
#include "piola/geometry/primitives.hpp"
#include "piola/setup/packed_bodies.hpp"
#include "exec/thread_count.hpp"
#include "particles/lattices.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

namespace piola::testing {
namespace {

using Point = std::array<double, 3>;

/// A quadratic field and its gradient.
double field(Point const& X) {
  return 1 + 2 * X[0] - X[1] + 3 * X[2] + X[0] * X[0] - 2 * X[1] * X[1] + X[0] * X[1] + 4 * X[1] * X[2];
}
double slope(int axis, Point const& X) {
  if (axis == 0) return 2 + 2 * X[0] + X[1];
  return axis == 1 ? -1 - 4 * X[1] + X[0] + 4 * X[2] : 3 + 4 * X[1];
}
/// Integral of the field over a piece of surface, from its moments about X and the field's derivatives there.
double over(std::array<double, 10> const& m, Point const& X) {
  double sum = field(X) * m[0];
  for (int c = 0; c < 3; ++c) sum += slope(c, X) * m[static_cast<std::size_t>(1 + c)];
  return sum + 2 * m[4] - 4 * m[5] + m[9] + 4 * m[7];
}

void expect_divergence_theorem(ParticleSet const& set) {
  auto const cells = measure_cells(set, set.bodies[0]);
  double volume = 0;
  Point inside{}, surface{};
  for (std::size_t a = 0; a < cells.cell.size(); ++a) {
    auto const& cell = cells.cell[a];
    volume += cell.volume;
    Point at = set.X[a];
    for (std::size_t c = 0; c < 3; ++c) at[c] += cell.centroid[c];
    for (int c = 0; c < set.dimension; ++c) inside[static_cast<std::size_t>(c)] += cell.volume * slope(c, at);
  }
  for (auto const& patch : cells.patch)
    for (std::size_t c = 0; c < 3; ++c)
      surface[c] += over(patch.moments[c], set.X[static_cast<std::size_t>(patch.particle)]);
  for (int c = 0; c < set.dimension; ++c)
    EXPECT_NEAR(inside[static_cast<std::size_t>(c)], surface[static_cast<std::size_t>(c)], 1e-11 * (1 + volume));
}

/// Every cell by itself: over its facets and its part of the surface.
void expect_closed_cells(ParticleSet const& set) {
  auto const cells = measure_cells(set, set.bodies[0], [](std::size_t) { return true; });
  EXPECT_FALSE(cells.facet.empty());
  std::vector<Point> vector(cells.cell.size()), moment(cells.cell.size());
  auto const add = [&](Index a, NormalMoments const& m, double sign, Point const& from) {
    auto const k = static_cast<std::size_t>(a);
    for (std::size_t c = 0; c < 3; ++c) {
      vector[k][c] += sign * m[c][0];
      moment[k][c] += sign * (m[c][1 + c] + (from[c] - set.X[k][c]) * m[c][0]);
    }
  };
  for (auto const& f : cells.facet) {
    Point middle{};
    for (std::size_t c = 0; c < 3; ++c)
      middle[c] = 0.5 * (set.X[static_cast<std::size_t>(f.a)][c] + set.X[static_cast<std::size_t>(f.b)][c]);
    add(f.a, f.moments, 1, middle);
    add(f.b, f.moments, -1, middle);
  }
  for (auto const& p : cells.patch) add(p.particle, p.moments, 1, set.X[static_cast<std::size_t>(p.particle)]);
  for (std::size_t a = 0; a < vector.size(); ++a)
    for (std::size_t c = 0; c < static_cast<std::size_t>(set.dimension); ++c) {
      EXPECT_NEAR(vector[a][c], 0, 1e-13);
      EXPECT_NEAR(moment[a][c], cells.cell[a].volume, 1e-13);
    }
}

ParticleSet ball(int dimension, ShapeSpec::Kind kind = ShapeSpec::Kind::sphere) {
  ShapeSpec shape;
  shape.kind = kind;
  shape.dimension = dimension;
  shape.radius = 0.5;
  shape.spacing = 0.1;
  shape.length = 0.7;
  ParticleSet set;
  fill(shape, "ball", set);
  return set;
}

TEST(CellMoments, OfALatticeAreThoseOfItsBlocksAtFacesEdgesAndCorners) {
  auto const set = unit_box(3, 5);
  auto const cells = measure_cells(set, set.bodies[0]);
  double const h = 0.25;
  auto const& corner = cells.cell[0];
  EXPECT_NEAR(corner.volume, h * h * h / 8, 1e-16);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(corner.centroid[c], h / 4, 1e-16);
    EXPECT_NEAR(corner.spread[c], h * h / 48, 1e-16);
    EXPECT_NEAR(corner.spread[3 + c], 0, 1e-16);
  }
  auto const& middle = cells.cell[2 + 5 * 2 + 25 * 2];
  EXPECT_NEAR(middle.volume, h * h * h, 1e-16);
  EXPECT_NEAR(middle.spread[1], h * h / 12, 1e-16);
  EXPECT_NEAR(middle.centroid[2], 0, 1e-16);
}

TEST(CellMoments, OfASampledLatticeAreExact) {
  auto set = unit_box(3, 4);
  auto const exact = measure_cells(set, set.bodies[0]);
  set.bodies[0].regular = false;  // as if it were any cloud
  auto const sampled = measure_cells(set, set.bodies[0]);
  ASSERT_EQ(exact.patch.size(), sampled.patch.size());
  for (std::size_t a = 0; a < exact.cell.size(); ++a) {
    EXPECT_NEAR(exact.cell[a].volume, sampled.cell[a].volume, 1e-15);
    for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(exact.cell[a].spread[c], sampled.cell[a].spread[c], 1e-15);
  }
}

TEST(CellMoments, ObeyTheDivergenceTheoremForQuadraticFields) {
  for (int D = 1; D <= 3; ++D) {
    expect_divergence_theorem(unit_box(D, 6));
    expect_divergence_theorem(unit_box(D, 6, 0.4));
    expect_divergence_theorem(ball(D));
    for (auto const& set : {unit_box(D, 6), unit_box(D, 6, 0.4), ball(D)}) expect_closed_cells(set);
  }
  expect_divergence_theorem(ball(3, ShapeSpec::Kind::cylinder));
}

TEST(CellMoments, OfABallHaveItsVolumeAndNotThatOfItsStaircase) {
  auto const set = ball(3);
  double volume = 0;
  for (auto const& cell : measure_cells(set, set.bodies[0]).cell) volume += cell.volume;
  EXPECT_NEAR(volume, 4.0 / 3 * M_PI * 0.125, 2e-3 * volume);
}

ParticleSet packed(geometry::SolidPtr const& solid, double volume, double spacing) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::solid;
  shape.arrangement = ShapeSpec::Arrangement::packed;
  shape.solid = solid;
  shape.dimension = solid->dimension();
  shape.volume = volume;
  shape.spacing = spacing;
  shape.solid_particles = std::make_shared<SolidParticles>();
  ParticleSet set;
  fill(shape, "body", set);
  return set;
}

/// The cells of a packed body, for which the divergence theorem holds. `error`: of the volume.
struct PackedCells {
  double volume = 0, height = 0;    ///< of the body, and of its centre of mass
  double least = 1e9, most = -1e9;  ///< height of its sides up and down

  PackedCells(geometry::SolidPtr const& solid, double exact, double spacing, double error = 1e-12) {
    ParticleSet const set = packed(solid, exact, spacing);
    expect_divergence_theorem(set);
    expect_closed_cells(set);
    auto const cells = measure_cells(set, set.bodies[0]);
    EXPECT_EQ(cells.unmoved, 0);
    for (std::size_t a = 0; a < cells.cell.size(); ++a) {
      volume += cells.cell[a].volume;
      height += cells.cell[a].volume * (set.X[a][2] + cells.cell[a].centroid[2]);
    }
    height /= volume;
    for (auto const& patch : cells.patch) {
      if (patch.axis != 2) continue;
      double const z = set.X[static_cast<std::size_t>(patch.particle)][2] + patch.extent[3] / patch.extent[0];
      least = std::min(least, z);
      most = std::max(most, z);
    }
    EXPECT_NEAR(volume / exact, 1, error);
  }
};

/// Chords of a sixth of a spacing over a radius R take (h / 6 R)^2 / 12 of a length and of an area.
TEST(CellMoments, OfPackedBodiesHaveTheExactVolume) {
  PackedCells(geometry::ball({{0.3, 0, 1}}, 0.5, 0, 3), M_PI / 6, 0.14, 1e-3);
  PackedCells(geometry::ball({{0.3, 0, 0}}, 0.5, 0.2, 2), M_PI * 0.21, 0.07, 3e-4);
  PackedCells(geometry::torus({}, {{0.6, 0, 0.8}}, 1, 0.3), 2 * M_PI * M_PI * 0.09, 0.2, 4e-3);
  PackedCells(geometry::box({}, {{1.03, 0.77, 0.58}}, 3), 1.03 * 0.77 * 0.58, 0.11);
}

/// Flat faces on the box around a body stay where they are.
TEST(CellMoments, OfPackedBodiesEndAtTheirFlatFaces) {
  PackedCells const bar(geometry::cylinder({}, {{0, 0, 1}}, 0.7, 0.2, 0), M_PI * 0.04 * 0.7, 0.1, 2e-3);
  EXPECT_NEAR(bar.least, 0, 1e-14);
  EXPECT_NEAR(bar.most, 0.7, 1e-14);
  EXPECT_NEAR(bar.height, 0.35, 1e-12);
  auto const half = geometry::combined(geometry::BooleanOperation::common,
                                       {geometry::ball({}, 0.5, 0, 3), geometry::box({{-1, -1, 0}}, {{1, 1, 1}}, 3)});
  PackedCells const dome(half, M_PI / 12, 0.1, 1e-3);
  EXPECT_NEAR(dome.least, 0, 1e-6);  // the topmost blocks of the dome end at the box, too
  EXPECT_NEAR(dome.height, 0.1875, 1e-3);
}

TEST(CellMoments, DoNotDependOnTheNumberOfThreads) {
  for (auto const& set : {unit_box(3, 6, 0.4), ball(3)}) {
    auto const measured = [&set](int threads) {
      Threads const guard(threads);
      BodyCells const cells = measure_cells(set, set.bodies[0], [](std::size_t) { return true; });
      std::vector<double> all;
      for (auto const& cell : cells.cell) {
        all.push_back(cell.volume);
        all.insert(all.end(), cell.centroid.begin(), cell.centroid.end());
        all.insert(all.end(), cell.spread.begin(), cell.spread.end());
      }
      for (auto const& patch : cells.patch) {
        all.insert(all.end(), {static_cast<double>(patch.particle), patch.extent[0]});
        for (auto const& m : patch.moments) all.insert(all.end(), m.begin(), m.end());
      }
      for (auto const& facet : cells.facet)
        for (auto const& m : facet.moments) all.insert(all.end(), m.begin(), m.end());
      return all;
    };
    auto const one = measured(1);
    for (int const threads : thread_counts) EXPECT_EQ(measured(threads), one) << threads;
  }
}

TEST(CellMoments, GiveParticlesVolumesThatFillTheBody) {
  auto set = unit_box(3, 5, 0.4);
  auto const before = set.volume;
  take_cell_volumes(set, set.bodies[0]);
  EXPECT_NE(set.volume, before);
  double sum = 0;
  for (double const V : set.volume) sum += V;
  EXPECT_NEAR(sum, 1, 1e-12);
}

}  // namespace
}  // namespace piola::testing
