// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/packing.hpp"
#include "piola/exec/threads.hpp"
#include "piola/geometry/boolean_solid.hpp"
#include "piola/geometry/patch_measures.hpp"
#include "piola/geometry/primitives.hpp"
#include <algorithm>
#include <array>
#include <gtest/gtest.h>

using namespace piola;
using namespace piola::geometry;

namespace {

Packing packed(Solid const& solid, double spacing) { return pack(solid, volume_of(solid, spacing), spacing); }

/// Shares and gaps are those that docs/theory/packing.md promises for smooth bodies. Where faces meet at a distance
/// that is no whole number of spacings, the outer layer cannot lie everywhere at half a spacing.
void expect_good(Solid const& solid, double spacing, double in_place = 0.93, double gap = 1.05) {
  Packing const packing = packed(solid, spacing);
  PackingQuality const q = quality_of(solid, packing);
  SCOPED_TRACE(packing.X.size());
  EXPECT_GT(q.nearest_least, 0.7);
  EXPECT_GT(q.nearest_mean, 0.9);
  EXPECT_GT(q.in_place, in_place);
  EXPECT_LT(q.gap, gap);
  EXPECT_NEAR(packing.volume * static_cast<double>(packing.X.size()), volume_of(solid, spacing),
              1e-12 * volume_of(solid, spacing));
  for (auto const& X : packing.X) EXPECT_LT(solid.at({{X[0], X[1], X[2]}}).distance, 0);
}

TEST(Packing, BallTenAndTwentyAcross) {
  auto const solid = ball({}, 0.5, 0, 3);
  expect_good(*solid, 0.1);
  expect_good(*solid, 0.05);
}

TEST(Packing, TorusTenPerTube) { expect_good(*torus({}, {{0, 0, 1}}, 1, 0.4), 0.08); }

TEST(Packing, Boxes) {
  expect_good(*box({}, {{1, 1, 1}}, 3), 0.1);
  // No whole number of spacings fits.
  expect_good(*box({}, {{1.03, 0.77, 0.58}}, 3), 0.09, 0.85);
}

TEST(Packing, InThePlane) {
  expect_good(*ball({}, 0.5, 0, 2), 0.05);
  expect_good(*ball({}, 0.5, 0.2, 2), 0.03);
  expect_good(*box({}, {{1, 0.5, 0}}, 2), 0.05);
}

TEST(Packing, BarIsAsDenseEverywhereAlongIt) {
  // 28.3 particles to a layer: of places as deep as each other some are taken, some are not.
  auto const bar = cylinder({}, {{1, 0, 0}}, 1, 0.03, 0);
  Packing const packing = packed(*bar, 0.01);
  std::array<int, 10> in_tenth{};
  for (auto const& X : packing.X) ++in_tenth[std::min<std::size_t>(9, static_cast<std::size_t>(10 * X[0]))];
  for (int const count : in_tenth) EXPECT_NEAR(10.0 * count / static_cast<double>(packing.X.size()), 1, 0.02);
}

TEST(Packing, PlateWithAHole) {
  auto const plate = combined(BooleanOperation::cut, {box({{-0.5, -0.5, 0}}, {{0.5, 0.5, 0.3}}, 3),
                                                      cylinder({{0, 0, -1}}, {{0, 0, 1}}, 3, 0.2, 0)});
  expect_good(*plate, 0.06, 0.9, 1.1);
}

TEST(Packing, IsTheSameForAnyNumberOfThreads) {
  auto const solid = torus({}, {{0.6, 0, 0.8}}, 1, 0.3);
  std::vector<Packing> packings;
  int const before = exec_host::threads(), least = exec_host::set_min_grain_size(1);
  for (int const threads : {1, 2, 3, 7}) {
    exec_host::set_threads(threads);
    packings.push_back(packed(*solid, 0.1));
  }
  exec_host::set_threads(before);
  exec_host::set_min_grain_size(least);
  for (Packing const& other : packings) EXPECT_EQ(other.X, packings.front().X);
}

TEST(Packing, OfFewParticlesStaysInside) {
  for (double const spacing : {0.5, 0.8}) {
    auto const solid = ball({}, 0.5, 0, 3);
    Packing const packing = packed(*solid, spacing);
    EXPECT_GE(packing.X.size(), 1u);
    for (auto const& X : packing.X) EXPECT_LT(solid->at({{X[0], X[1], X[2]}}).distance, 0);
  }
}

TEST(Packing, CanBeStopped) {
  auto const solid = ball({}, 0.5, 0, 3);
  PackingOptions options;
  options.progress = [](int sweep) { return sweep < 3; };
  EXPECT_EQ(pack(*solid, volume_of(*solid, 0.1), 0.1, options).sweeps, 3);
}

TEST(Packing, ContinuesBitForBitFromAnySweep) {
  auto const solid = torus({}, {{0.6, 0, 0.8}}, 1, 0.3);
  double const volume = volume_of(*solid, 0.1);
  Packing const whole = pack(*solid, volume, 0.1);
  ASSERT_GT(whole.sweeps, 12);
  EXPECT_FALSE(whole.unfinished);
  PackingOptions options;
  for (int const sweeps : {1, 4, 5, 12}) {  // neighbours are looked for in every fifth
    options.progress = [&](int sweep) { return sweep < sweeps; };
    Packing const part = pack(*solid, volume, 0.1, options);
    options.from = part.unfinished;
    ASSERT_TRUE(options.from) << sweeps;
  }
  EXPECT_EQ(options.from->sweeps, 12);
  options.progress = {};
  Packing const continued = pack(*solid, volume, 0.1, options);
  EXPECT_EQ(continued.X, whole.X);
  EXPECT_EQ(continued.sweeps, whole.sweeps);
}

}  // namespace
