// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/shapes.hpp"
#include "exec/thread_count.hpp"
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
    shape.placement = ShapeSpec::Placement::cell_centred;
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
}

/// SplitMix64 as its authors wrote it (Vigna's splitmix64.c): the state moves on by a constant, its bits are mixed.
std::uint64_t split_mix(std::uint64_t& state) {
  state += 0x9E3779B97F4A7C15U;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31);
}

TEST(Shapes, JitterIsANumberOfSplitMix64ForThePlaceInTheLatticeAndTheAxis) {
  ShapeSpec shape = box({0, 0, 0}, {5, 7, 4}, {5, 7, 4});
  shape.placement = ShapeSpec::Placement::cell_centred;
  ParticleSet const plain = filled(shape);
  shape.jitter = 0.3;
  shape.seed = 5489;
  ParticleSet const set = filled(shape);
  std::uint64_t seed = (std::uint64_t{1} << 32) + shape.seed;
  std::uint64_t state = split_mix(seed) - 0x9E3779B97F4A7C15U;  // its first number is for place 0 and axis 0
  for (std::size_t id = 0; id < set.X.size(); ++id)
    for (std::size_t d = 0; d < 3; ++d) {
      double const drawn = static_cast<double>(split_mix(state)) * 0x1p-64;
      EXPECT_NEAR(set.X[id][d], plain.X[id][d] + 0.3 * (2 * drawn - 1), 4e-15) << id << " " << d;
    }
}

/// Compares with theory: mean 0, mean square 1/3, no correlation with the next particle or the next axis. The bounds
/// are four standard deviations of a sum of n independent numbers.
TEST(Shapes, JitterIsUniformAndWithoutCorrelation) {
  ShapeSpec shape = box({0, 0, 0}, {40, 40, 40}, {40, 40, 40});
  shape.placement = ShapeSpec::Placement::cell_centred;
  ParticleSet const plain = filled(shape);
  shape.jitter = 0.4;
  ParticleSet const set = filled(shape);
  auto const n = set.X.size();
  auto const shift = [&](std::size_t id, std::size_t d) { return (set.X[id % n][d] - plain.X[id % n][d]) / 0.4; };
  double const root = std::sqrt(static_cast<double>(n));
  for (std::size_t d = 0; d < 3; ++d) {
    double mean = 0, square = 0, next = 0, row = 0, plane = 0, axis = 0;
    for (std::size_t id = 0; id < n; ++id) {
      double const s = shift(id, d);
      EXPECT_LE(std::abs(s), 1 + 1e-12);
      mean += s;
      square += s * s;
      next += s * shift(id + 1, d);
      row += s * shift(id + 40, d);
      plane += s * shift(id + 1600, d);
      axis += s * shift(id, (d + 1) % 3);
    }
    EXPECT_LE(std::abs(mean), 4 * root * std::sqrt(1.0 / 3));
    EXPECT_LE(std::abs(square - static_cast<double>(n) / 3), 4 * root * std::sqrt(4.0 / 45));
    for (double const correlation : {next, row, plane, axis}) EXPECT_LE(std::abs(correlation), 4 * root / 3);
  }
}

ShapeSpec disc(double radius, double spacing) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::sphere;
  shape.dimension = 2;
  shape.radius = radius;
  shape.spacing = spacing;
  return shape;
}

TEST(Shapes, ABoxOfCellsHasExactlyAsManyAsItsEdgesAskFor) {
  auto const cells = [](double length, double spacing) {
    return particles_over(length, spacing, ShapeSpec::Placement::cell_centred);
  };
  double const d = 1e-4;  // adaptle: plate of 20 columns of 501 rows, one row on the axis
  ShapeSpec plate = box({0, -250.5 * d, 0}, {20 * d, 250.5 * d, 0}, {cells(20 * d, d), cells(501 * d, d), 1}, 2);
  plate.placement = ShapeSpec::Placement::cell_centred;
  ParticleSet const set = filled(plate);
  ASSERT_EQ(set.size(), 20 * 501);
  for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(set.bodies[0].spacing[c], d, 1e-15 * d * 501);
  EXPECT_NEAR(set.X[250 * 20][1], 0, 1e-12 * d);
  ShapeSpec slab = box({-0.05, -0.05, 0}, {0.05, 0.05, 0.003}, {cells(0.1, 1e-3), cells(0.1, 1e-3), cells(3e-3, 1e-3)});
  slab.placement = ShapeSpec::Placement::cell_centred;
  EXPECT_EQ(filled(slab).size(), 30000);
}

TEST(Shapes, ASphereOfSixSpacingsHas912Particles) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::sphere;
  shape.radius = 6e-3;
  shape.spacing = 1e-3;
  shape.centre = {0.1, 0.2, 0.3};
  ParticleSet const set = filled(shape);
  EXPECT_EQ(set.size(), 912);
  double const from_centre = (set.X[0][0] - 0.1) / 1e-3;
  EXPECT_NEAR(from_centre - std::floor(from_centre), 0.5, 1e-9);
}

TEST(Shapes, HollowBodiesLeaveOutWhatIsNearerThanTheInnerRadius) {
  for (int dimension = 2; dimension <= 3; ++dimension) {
    // An odd number of cells: points lie on whole spacings, some of them exactly on the inner surface.
    ShapeSpec shape = disc(0.45, 0.1);
    shape.dimension = dimension;
    ParticleSet const solid = filled(shape);
    shape.inner_radius = 0.3;
    ParticleSet const set = filled(shape);
    std::int64_t expected = 0;
    for (auto const& index : solid.lattice_index) {
      int const x = index[0] - 4, y = index[1] - 4, z = dimension == 3 ? index[2] - 4 : 0;
      expected += x * x + y * y + z * z >= 9 ? 1 : 0;
    }
    EXPECT_EQ(set.size(), expected);
    EXPECT_EQ(count_particles(shape), expected);
    EXPECT_TRUE(set.bodies[0].regular);
    EXPECT_FALSE(set.bodies[0].off_lattice);
  }
}

TEST(Shapes, ACylinderMayHaveHalfCellsOnItsEnds) {
  for (int axis = 0; axis < 3; ++axis) {
    ShapeSpec shape;
    shape.kind = ShapeSpec::Kind::cylinder;
    shape.centre = {1, 2, 3};
    shape.radius = 0.5;
    shape.length = 2;
    shape.axis = axis;
    shape.spacing = 0.1;
    auto const a = static_cast<std::size_t>(axis);
    shape.placement = ShapeSpec::Placement::cell_centred;
    double const volume = sum(filled(shape).volume);
    shape.placement = ShapeSpec::Placement::on_boundary;
    ParticleSet const set = filled(shape);
    EXPECT_EQ(set.size(), count_particles(shape));
    EXPECT_NEAR(sum(set.volume), volume, 1e-12);
    int ends = 0;
    for (std::size_t i = 0; i < set.X.size(); ++i) {
      bool const end = set.X[i][a] == shape.centre[a] || set.X[i][a] == shape.centre[a] + 2;
      ends += end ? 1 : 0;
      EXPECT_NEAR(set.volume[i], end ? 0.0005 : 0.001, 1e-12);
    }
    EXPECT_EQ(ends * 21, 2 * set.size());
  }
}

TEST(Shapes, ATubeIsHollowAllAlong) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::cylinder;
  shape.placement = ShapeSpec::Placement::cell_centred;
  shape.radius = 1;
  shape.length = 2;
  shape.axis = 0;
  shape.spacing = 0.1;
  std::int64_t expected = 0;
  for (auto const& X : filled(shape).X) expected += std::hypot(X[1], X[2]) > 0.55 ? 1 : 0;
  shape.inner_radius = 0.55;
  ParticleSet const set = filled(shape);
  EXPECT_EQ(set.size(), expected);
  EXPECT_EQ(count_particles(shape), expected);
  EXPECT_EQ(set.size() % 20, 0);
  for (auto const& X : set.X) EXPECT_GT(std::hypot(X[1], X[2]), 0.55);
}

// adaptle, 8.2: counts of the published layouts of a disc of radius 50 spacings.
TEST(Shapes, DiscsOfRingsHaveThePublishedCounts) {
  ShapeSpec shape = disc(5e-3, 1e-4);
  shape.centre = {-0.01, 0.02, 0};
  shape.arrangement = ShapeSpec::Arrangement::rings;
  ParticleSet const set = filled(shape);
  EXPECT_EQ(set.size(), 8012);
  EXPECT_EQ(count_particles(shape), 8012);
  EXPECT_EQ(set.X[0], (std::array<double, 3>{-0.01, 0.02, 0}));
  EXPECT_NEAR(set.X[1][0], -0.01 + 1e-4, 1e-16);  // six around the first, beginning on the axis
  EXPECT_NEAR(set.X[3][0], -0.01 - 0.5e-4, 1e-16);
  double outermost = 0;
  for (auto const& X : set.X) outermost = std::max(outermost, std::hypot(X[0] + 0.01, X[1] - 0.02));
  EXPECT_NEAR(outermost, 5e-3, 1e-15);
  for (double const volume : set.volume) EXPECT_DOUBLE_EQ(volume, 1e-8);
  EXPECT_FALSE(set.bodies[0].regular);
  EXPECT_TRUE(set.bodies[0].off_lattice);
}

TEST(Shapes, ALatticeWithRingsHasThePublishedCounts) {
  ShapeSpec shape = disc(5e-3, 1e-4);
  shape.arrangement = ShapeSpec::Arrangement::lattice_with_rings;
  ParticleSet const set = filled(shape);
  EXPECT_EQ(set.size(), 7830);
  EXPECT_EQ(count_particles(shape), 7830);
  std::array<int, 3> counts{};
  for (auto const& X : set.X) {
    double const r = std::hypot(X[0], X[1]) / 1e-4;
    ++counts[r < 48 - 1e-6 ? 0 : std::abs(r - 49) < 1e-9 ? 1 : 2];
  }
  EXPECT_EQ(counts, (std::array<int, 3>{7209, 307, 314}));
  for (double const volume : set.volume) EXPECT_DOUBLE_EQ(volume, 1e-8);
}

TEST(Shapes, ARingIsAPolarGridWithItsExactArea) {
  ShapeSpec shape = disc(2, 0.24);
  shape.inner_radius = 1;
  shape.arrangement = ShapeSpec::Arrangement::rings;
  ParticleSet const set = filled(shape);
  // Four circles 0.25 apart; 2 pi 1.5 / 0.25 = 37.7.
  ASSERT_EQ(set.size(), 4 * 38);
  EXPECT_EQ(count_particles(shape), 4 * 38);
  EXPECT_EQ(spacing_of(shape), (std::array<double, 3>{0.25, 0.25, 1}));
  EXPECT_EQ(set.bodies[0].spacing, spacing_of(shape));
  EXPECT_NEAR(sum(set.volume), 3 * std::numbers::pi, 1e-13);
  for (std::size_t i = 0; i < 38; ++i) {
    EXPECT_NEAR(std::hypot(set.X[i][0], set.X[i][1]), 1.125, 1e-14);
    EXPECT_NEAR(std::atan2(set.X[i][1], set.X[i][0]), std::atan2(set.X[114 + i][1], set.X[114 + i][0]), 1e-13);
  }
  EXPECT_NEAR(set.X[0][1], 0, 1e-15);
}

TEST(Shapes, LatticeIndicesOfRingsStayInTheirRange) {
  for (auto const arrangement : {ShapeSpec::Arrangement::rings, ShapeSpec::Arrangement::lattice_with_rings}) {
    for (double const radius : {0.05, 0.1, 0.2, 0.33, 1.04}) {
      ShapeSpec shape = disc(radius, 0.1);
      shape.arrangement = arrangement;
      ParticleSet const set = filled(shape);
      EXPECT_GT(set.size(), 0);
      EXPECT_EQ(set.size(), count_particles(shape));
      for (auto const& index : set.lattice_index) {
        for (std::size_t c = 0; c < 3; ++c) EXPECT_TRUE(index[c] >= 0 && index[c] < set.bodies[0].lattice[c]);
      }
    }
  }
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
  shape.dimension = 2;
  shape.spacing = 1e-15;
  shape.arrangement = ShapeSpec::Arrangement::rings;
  EXPECT_GT(count_particles(shape), 1LL << 60);
  EXPECT_EQ(particles_over(1, 1e-30, ShapeSpec::Placement::on_boundary), 2147483647);
  EXPECT_EQ(particles_over(6, 0.25, ShapeSpec::Placement::on_boundary), 25);
  EXPECT_EQ(particles_over(6, 0.25, ShapeSpec::Placement::cell_centred), 24);
  EXPECT_EQ(particles_over(0.1, 1, ShapeSpec::Placement::on_boundary), 1);
}

TEST(Fill, GivesTheSameParticlesForAnyNumberOfThreads) {
  ShapeSpec box;
  box.max = {1, 2, 3};
  box.particles = {5, 9, 13};
  box.jitter = 0.4;
  ShapeSpec ball;
  ball.kind = ShapeSpec::Kind::sphere;
  ball.centre = {9, 0, 0};
  ball.radius = 1;
  ball.inner_radius = 0.4;
  ball.spacing = 0.11;
  auto const filled = [&](int threads) {
    testing::Threads const some(threads);
    ParticleSet set;
    fill(box, "box", set);
    fill(ball, "ball", set);
    return set;
  };
  ParticleSet const one = filled(1), three = filled(3);
  EXPECT_EQ(one.X, three.X);
  EXPECT_EQ(one.lattice_index, three.lattice_index);
  EXPECT_EQ(one.volume, three.volume);
  EXPECT_EQ(one.kernel_volume, three.kernel_volume);
  EXPECT_EQ(one.body, three.body);
  EXPECT_EQ(one.size(), one.bodies[1].last);
}

}  // namespace
}  // namespace piola
