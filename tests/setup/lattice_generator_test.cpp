// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/lattice_generator.hpp"
#include "exec/thread_count.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

ShapeSpec brick(int dimension, std::array<int, 3> particles, ShapeSpec::Placement placement) {
  ShapeSpec shape;
  shape.dimension = dimension;
  shape.particles = particles;
  shape.placement = placement;
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) {
    shape.min[c] = -0.3 * static_cast<double>(c);
    shape.max[c] = 1.7 + 0.9 * static_cast<double>(c);
  }
  return shape;
}

ShapeSpec round(ShapeSpec::Kind kind, int dimension, double inner_radius) {
  ShapeSpec shape;
  shape.kind = kind;
  shape.dimension = dimension;
  shape.centre = {0.1, 0.2, dimension == 3 ? 0.3 : 0};
  shape.radius = 1;
  shape.inner_radius = inner_radius;
  shape.length = 1.3;
  shape.axis = 1;
  shape.spacing = 0.11;
  return shape;
}

std::vector<ShapeSpec> shapes() {
  using Kind = ShapeSpec::Kind;
  using Placement = ShapeSpec::Placement;
  std::vector<ShapeSpec> all{brick(1, {60, 1, 1}, Placement::on_boundary),
                             brick(2, {23, 17, 1}, Placement::on_boundary),
                             brick(3, {9, 13, 8}, Placement::on_boundary),
                             brick(3, {9, 1, 8}, Placement::cell_centred),
                             round(Kind::sphere, 3, 0),
                             round(Kind::sphere, 3, 0.4),
                             round(Kind::sphere, 2, 0.55),
                             round(Kind::cylinder, 3, 0.3)};
  for (std::size_t k = 0; k < 8; ++k) {
    all.push_back(all[k]);
    all.back().jitter = 0.3;
    all.back().seed = 11;
  }
  return all;
}

TEST(LatticeGenerator, GivesTheParticlesOfABodyOnAnyNumberOfThreads) {
  for (ShapeSpec const& shape : shapes())
    for (int const count : {1, 2, 3}) {
      testing::Threads const threads(count);
      ParticleSet set;
      fill(shape, "body", set);
      LatticeGenerator const births(shape);
      ASSERT_EQ(births.size(), set.size());
      std::array<int, 3> before{-1, 0, 0};  // ids follow the lattice, the first direction fastest
      for (std::size_t id = 0; id < set.X.size(); ++id) {
        auto const& [i, j, k] = set.lattice_index[id];
        EXPECT_LT((std::array{before[2], before[1], before[0]}), (std::array{k, j, i}));
        before = {i, j, k};
        GeneratedParticle const born = births.at(before);
        EXPECT_EQ(born.X, set.X[id]);
        EXPECT_EQ(born.volume, set.volume[id]);
        EXPECT_EQ(births.kernel_volume(), set.kernel_volume[id]);
      }
    }
}

/// A lattice of 8e18 places cannot be made, but its particles can, one by one.
TEST(LatticeGenerator, CountsBeyondThirtyTwoBits) {
  constexpr int n = 2'000'000;
  ShapeSpec shape;
  shape.max = {1, 1, 1};
  shape.particles = {n, n, n};
  shape.jitter = 0.2;
  LatticeGenerator const births(shape);
  EXPECT_EQ(births.size(), std::int64_t{n} * n * n);
  EXPECT_EQ(births.at({n - 1, n - 1, n - 1}).X, (std::array<double, 3>{1, 1, 1}));
  std::array<int, 3> const inner{n - 3, n - 2, n - 2};
  for (std::size_t c = 0; c < 3; ++c) {
    double const spacing = 1.0 / (n - 1), place = spacing * inner[c], X = births.at(inner).X[c];
    EXPECT_NE(X, place);
    EXPECT_NEAR(X, place, 0.2 * spacing);
  }
}

}  // namespace
}  // namespace piola
