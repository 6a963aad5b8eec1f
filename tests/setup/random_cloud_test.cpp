// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/shapes.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace piola {
namespace {

ParticleSet random_box(int dimension, std::uint32_t seed) {
  ShapeSpec shape;
  shape.dimension = dimension;
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) {
    shape.min[c] = -1;
    shape.max[c] = 1 + static_cast<double>(c);
    shape.particles[c] = 7 + 3 * static_cast<int>(c);
  }
  shape.random = true;
  shape.seed = seed;
  ParticleSet set;
  fill(shape, "box", set);
  return set;
}

double distance(ParticleSet const& set, std::size_t a, std::size_t b) {
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) square += std::pow((set.X[a][c] - set.X[b][c]) / set.bodies[0].spacing[c], 2);
  return std::sqrt(square);
}

TEST(RandomCloud, StaysOnFacesFillsTheBoxEvenlyAndHasItsVolume) {
  for (int D = 1; D <= 3; ++D) {
    ParticleSet const set = random_box(D, 1);
    double volume = 0, whole = 1, least = std::numeric_limits<double>::infinity();
    int moved = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(D); ++c) whole *= 2 + static_cast<double>(c);
    for (std::size_t a = 0; a < set.X.size(); ++a) {
      volume += set.volume[a];
      EXPECT_GT(set.volume[a], 0);
      bool on_face = false;
      double shift = 0;
      for (std::size_t c = 0; c < static_cast<std::size_t>(D); ++c) {
        int const at = set.lattice_index[a][c], last = set.bodies[0].lattice[c] - 1;
        double const born = -1 + at * set.bodies[0].spacing[c];
        on_face = on_face || at == 0 || at == last;
        shift = std::max(shift, std::fabs(set.X[a][c] - born) / set.bodies[0].spacing[c]);
        EXPECT_GE(set.X[a][c], -1);
        EXPECT_LE(set.X[a][c], 1 + static_cast<double>(c));
      }
      if (on_face) {
        EXPECT_LT(shift, 1e-12);
      }
      moved += shift > 0.2 ? 1 : 0;
      for (std::size_t b = 0; b < a; ++b) least = std::min(least, distance(set, a, b));
    }
    EXPECT_NEAR(volume, whole, 1e-12);
    EXPECT_GT(moved, 2) << D;
    EXPECT_GT(least, 0.35) << "Lloyd's steps part what came to lie together, in " << D;
    EXPECT_FALSE(set.bodies[0].regular);
  }
}

TEST(RandomCloud, IsTheSameForASeedAndAnotherForAnother) {
  EXPECT_EQ(random_box(3, 4).X, random_box(3, 4).X);
  EXPECT_NE(random_box(3, 4).X, random_box(3, 5).X);
}

}  // namespace
}  // namespace piola
