// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/lattice_generator.hpp"
#include "exec/thread_count.hpp"
#include <gtest/gtest.h>
#include <random>

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

/// The lattice cut into two at random places, these again, and so on.
void cut(LatticeBox const& box, int depth, std::mt19937& random, std::vector<LatticeBox>& parts) {
  auto const c = static_cast<std::size_t>(random() % 3);
  int const n = box.last[c] - box.first[c];
  if (depth == 0) {
    parts.push_back(box);
    return;
  }
  LatticeBox low = box, high = box;
  low.last[c] = high.first[c] = box.first[c] + static_cast<int>(random() % static_cast<unsigned>(n + 1));
  cut(low, depth - 1, random, parts);
  cut(high, depth - 1, random, parts);
}

TEST(LatticeGenerator, OfAllPartsAreThoseOfTheWholeBitForBit) {
  std::mt19937 random(3);
  for (ShapeSpec const& shape : shapes())
    for (int trial = 0; trial < 4; ++trial) {
      testing::Threads const threads(1 + trial % 3);
      ParticleSet set;
      fill(shape, "body", set);
      LatticeGenerator const births(shape);
      EXPECT_EQ(births.size(), set.size());
      std::vector<LatticeBox> parts;
      cut(births.everywhere(), 5, random, parts);
      std::vector<int> seen(set.X.size(), 0);
      for (LatticeBox const& part : parts) {
        GeneratedParticles const born = births.in(part);
        EXPECT_EQ(static_cast<std::int64_t>(born.id.size()), births.count(part));
        for (std::size_t k = 0; k < born.id.size(); ++k) {
          auto const id = static_cast<std::size_t>(born.id[k]);
          ASSERT_LT(id, set.X.size());
          ++seen[id];
          EXPECT_EQ(born.X[k], set.X[id]);
          EXPECT_EQ(born.lattice_index[k], set.lattice_index[id]);
          EXPECT_EQ(born.volume[k], set.volume[id]);
          EXPECT_EQ(born.kernel_volume, set.kernel_volume[id]);
        }
      }
      EXPECT_EQ(seen, std::vector<int>(set.X.size(), 1));
    }
}

/// A lattice of 8e18 places cannot be made, but a corner of it can.
TEST(LatticeGenerator, CountBeyondThirtyTwoBits) {
  constexpr int n = 2'000'000;
  ShapeSpec shape;
  shape.max = {1, 1, 1};
  shape.particles = {n, n, n};
  shape.jitter = 0.2;
  LatticeGenerator const births(shape);
  std::int64_t const all = std::int64_t{n} * n * n;
  EXPECT_EQ(births.size(), all);
  GeneratedParticles const last = births.in({{n - 2, n - 1, n - 1}, {n, n, n}});
  EXPECT_EQ(last.id, (std::vector<std::int64_t>{all - 2, all - 1}));
  EXPECT_EQ(last.X.back(), (std::array<double, 3>{1, 1, 1}));
  GeneratedParticles const inner = births.in({{n - 3, n - 2, n - 2}, {n - 2, n - 1, n - 1}});
  ASSERT_EQ(inner.id.size(), 1U);
  EXPECT_EQ(inner.id[0], (std::int64_t{n - 2} * n + n - 2) * n + n - 3);
  for (std::size_t c = 0; c < 3; ++c) {
    double const spacing = 1.0 / (n - 1), place = spacing * inner.lattice_index[0][c];
    EXPECT_NE(inner.X[0][c], place);
    EXPECT_NEAR(inner.X[0][c], place, 0.2 * spacing);
  }
}

}  // namespace
}  // namespace piola
