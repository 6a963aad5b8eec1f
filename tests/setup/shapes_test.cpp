// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/shapes.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

namespace piola {
namespace {

ShapeSpec box(std::array<double, 3> min, std::array<double, 3> max, std::array<int, 3> particles, int dimension = 3) {
  ShapeSpec shape;
  shape.dimension = dimension;
  shape.min = min;
  shape.max = max;
  shape.particles = particles;
  return shape;
}

ParticleSet filled(ShapeSpec const& shape) {
  ParticleSet set;
  fill(shape, "body", set);
  return set;
}

double sum(std::vector<double> const& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST(Shapes, BoxWithParticlesOnTheBoundaryReachesBothFaces) {
  ParticleSet const set = filled(box({-0.5, 0, -0.5}, {0.5, 6, 0.5}, {5, 25, 5}));
  ASSERT_EQ(set.size(), 625);
  EXPECT_EQ(set.X.front(), (std::array<double, 3>{-0.5, 0, -0.5}));
  EXPECT_EQ(set.X.back(), (std::array<double, 3>{0.5, 6, 0.5}));
  EXPECT_EQ(set.bodies[0].spacing, (std::array<double, 3>{0.25, 0.25, 0.25}));
  EXPECT_EQ(set.bodies[0].lattice, (std::array<int, 3>{5, 25, 5}));
  EXPECT_TRUE(set.bodies[0].regular);
}

TEST(Shapes, IdsRunAlongXThenYThenZ) {
  ParticleSet const set = filled(box({0, 0, 0}, {1, 2, 3}, {2, 3, 4}));
  for (int k = 0, id = 0; k < 4; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 2; ++i, ++id) {
        EXPECT_EQ(set.lattice_index[static_cast<std::size_t>(id)], (std::array<int, 3>{i, j, k}));
      }
    }
  }
}

TEST(Shapes, TributaryVolumesAreHalvedAtFacesEdgesAndCorners) {
  ParticleSet const set = filled(box({0, 0, 0}, {2, 2, 2}, {3, 3, 3}));
  EXPECT_DOUBLE_EQ(set.volume[0], 1.0 / 8);  // corner
  EXPECT_DOUBLE_EQ(set.volume[1], 1.0 / 4);  // edge
  EXPECT_DOUBLE_EQ(set.volume[4], 1.0 / 2);  // face
  EXPECT_DOUBLE_EQ(set.volume[13], 1.0);     // middle
  for (double const volume : set.kernel_volume) EXPECT_DOUBLE_EQ(volume, 1);
}

TEST(Shapes, TributaryVolumesOfABoxSumToItsVolumeInEveryDimension) {
  for (auto const placement : {ShapeSpec::Placement::on_boundary, ShapeSpec::Placement::cell_centred}) {
    for (int dimension = 1; dimension <= 3; ++dimension) {
      ShapeSpec shape = box({0, 0, 0}, {0.3, 1.7, 0.9}, {4, 7, 1}, dimension);
      shape.placement = placement;
      double const exact = dimension == 1 ? 0.3 : dimension == 2 ? 0.3 * 1.7 : 0.3 * 1.7 * 0.9;
      EXPECT_NEAR(sum(filled(shape).volume), exact, 1e-14 * exact);
    }
  }
}

TEST(Shapes, ASingleParticleInADirectionSitsInTheMiddle) {
  ParticleSet const set = filled(box({0, 0, 0}, {1, 1, 4}, {2, 2, 1}));
  EXPECT_DOUBLE_EQ(set.X[0][2], 2);
  EXPECT_DOUBLE_EQ(set.bodies[0].spacing[2], 4);
  EXPECT_DOUBLE_EQ(set.kernel_volume[0], 4);
  EXPECT_DOUBLE_EQ(set.volume[0], 1);
}

TEST(Shapes, CellCentredParticlesStayHalfASpacingInside) {
  ShapeSpec shape = box({0, 0, 0}, {1, 2, 0}, {4, 8, 1}, 2);
  shape.placement = ShapeSpec::Placement::cell_centred;
  ParticleSet const set = filled(shape);
  ASSERT_EQ(set.size(), 32);
  EXPECT_DOUBLE_EQ(set.X[0][0], 0.125);
  EXPECT_DOUBLE_EQ(set.X.back()[1], 1.875);
  EXPECT_DOUBLE_EQ(set.X[0][2], 0);
  EXPECT_DOUBLE_EQ(set.bodies[0].spacing[2], 1);
}

TEST(Shapes, RoundBodiesAreSymmetricAndCountedExactly) {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    for (double const radius : {0.4, 1.0, 1.07, 2.3}) {
      ShapeSpec shape;
      shape.kind = ShapeSpec::Kind::sphere;
      shape.dimension = dimension;
      shape.centre = {0, 0, 0};
      shape.radius = radius;
      shape.spacing = 0.25;
      ParticleSet const set = filled(shape);
      EXPECT_EQ(set.size(), count_particles(shape));
      std::array<double, 3> middle{};
      for (auto const& X : set.X) {
        EXPECT_LE(std::hypot(X[0], X[1], X[2]), radius * (1 + 1e-12));
        for (std::size_t d = 0; d < 3; ++d) middle[d] += X[d];
      }
      for (double const m : middle) EXPECT_NEAR(m, 0, 1e-10);
    }
  }
}

TEST(Shapes, AFineSphereHasNearlyItsExactVolume) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::sphere;
  shape.radius = 1;
  shape.spacing = 0.05;
  EXPECT_NEAR(sum(filled(shape).volume), 4 * std::numbers::pi / 3, 0.03);
}

TEST(Shapes, ACylinderFillsItsLengthAlongAnyAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    ShapeSpec shape;
    shape.kind = ShapeSpec::Kind::cylinder;
    shape.centre = {1, 2, 3};
    shape.radius = 0.5;
    shape.length = 2;
    shape.axis = axis;
    shape.spacing = 0.11;
    ParticleSet const set = filled(shape);
    EXPECT_EQ(set.size(), count_particles(shape));
    auto const a = static_cast<std::size_t>(axis);
    double low = 1e9, high = -1e9;
    for (auto const& X : set.X) {
      low = std::min(low, X[a]);
      high = std::max(high, X[a]);
    }
    double const start = shape.centre[a];
    EXPECT_NEAR(low - start, start + 2 - high, 1e-12);
    EXPECT_NEAR(low - start, set.bodies[0].spacing[a] / 2, 1e-12);
  }
}

TEST(Shapes, JitterMovesOnlyInnerParticlesAndIsTheSameForASeed) {
  ShapeSpec shape = box({0, 0, 0}, {1, 1, 1}, {5, 5, 5});
  ParticleSet const plain = filled(shape);
  shape.jitter = 0.2;
  shape.seed = 7;
  ParticleSet const set = filled(shape);
  EXPECT_FALSE(set.bodies[0].regular);
  EXPECT_EQ(set.X, filled(shape).X);
  int moved = 0;
  for (std::size_t id = 0; id < set.X.size(); ++id) {
    bool inner = true;
    for (int const i : set.lattice_index[id]) inner = inner && i > 0 && i < 4;
    for (std::size_t d = 0; d < 3; ++d) EXPECT_LE(std::abs(set.X[id][d] - plain.X[id][d]), 0.2 * 0.25);
    EXPECT_EQ(set.X[id] != plain.X[id], inner);
    moved += inner ? 1 : 0;
  }
  EXPECT_EQ(moved, 27);
  shape.seed = 8;
  EXPECT_NE(set.X, filled(shape).X);
  // Fixed by the C++ standard: the 10000th number of mt19937 with seed 5489 is known; this is our mapping of the first.
  EXPECT_NEAR(filled([] {
                ShapeSpec line = box({0, 0, 0}, {2, 0, 0}, {3, 1, 1}, 1);
                line.placement = ShapeSpec::Placement::cell_centred;
                line.jitter = 0.3;
                line.seed = 5489;
                return line;
              }())
                  .X[0][0],
              1.0 / 3 + 0.3 * (2.0 / 3) * ((3499211612.0 + 0.5) / 2147483648.0 - 1), 1e-15);
}

TEST(Shapes, SeveralBodiesShareOneSet) {
  ParticleSet set;
  fill(box({0, 0, 0}, {1, 1, 0}, {3, 3, 1}, 2), "a", set);
  fill(box({2, 0, 0}, {3, 1, 0}, {2, 2, 1}, 2), "b", set);
  ASSERT_EQ(set.bodies.size(), 2u);
  EXPECT_EQ(set.bodies[1].first, 9);
  EXPECT_EQ(set.bodies[1].last, 13);
  EXPECT_EQ(set.body.back(), 1);
  EXPECT_EQ(set.dimension, 2);
}

TEST(Shapes, AbsurdNumbersAreCountedWithoutMakingThem) {
  EXPECT_GT(count_particles(box({0, 0, 0}, {1, 1, 1}, {2000000000, 2000000000, 2000000000})), 1LL << 60);
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::sphere;
  shape.radius = 1;
  shape.spacing = 1e-12;
  EXPECT_GT(count_particles(shape), 1LL << 60);
  EXPECT_EQ(particles_over(1, 1e-30, ShapeSpec::Placement::on_boundary), 2147483647);
  EXPECT_EQ(particles_over(6, 0.25, ShapeSpec::Placement::on_boundary), 25);
  EXPECT_EQ(particles_over(6, 0.25, ShapeSpec::Placement::cell_centred), 24);
  EXPECT_EQ(particles_over(0.1, 1, ShapeSpec::Placement::on_boundary), 1);
}

}  // namespace
}  // namespace piola
