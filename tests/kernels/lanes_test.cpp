// SPDX-License-Identifier: Apache-2.0
// Kernels on packs of lanes against the same on one double. This file is a machine of its own.
#undef PIOLA_BACKEND
#undef PIOLA_BACKEND_IS_HOST
#define PIOLA_BACKEND test_packs
#define PIOLA_BACKEND_IS_NATIVE 1
#include "piola/kernels/cubic_spline.hpp"
#include "piola/kernels/wendland_c2.hpp"
#include <gtest/gtest.h>

namespace piola::inline PIOLA_BACKEND {
namespace {

/// f of a pack whose lanes lie on different sides of the kernel's knots, beside f of each lane alone. A compiler may
/// fuse products and sums of one and not of the other: a few units in the last place of numbers up to 2.
template <class F>
void expect_the_same_on_lanes(F const& f) {
  int compared = 0;
  for (double first = 0; first < 2.6; first += 0.01) {
    Lanes q(0.0);
    double alone[lane_count];
    for (int l = 0; l < lane_count; ++l) q[l] = alone[l] = first + 0.37 * l;
    Lanes const many = f(q);
    for (int l = 0; l < lane_count; ++l) {
      EXPECT_NEAR(lane(many, l), f(alone[l]), 2e-15) << alone[l];
      compared += f(alone[l]) != 0 ? 1 : 0;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(KernelsOnLanes, AreThoseOfEachLane) {
  expect_the_same_on_lanes([](auto const& q) { return CubicSpline::w(q); });
  expect_the_same_on_lanes([](auto const& q) { return CubicSpline::dw(q); });
  for (int D = 1; D <= 3; ++D) {
    expect_the_same_on_lanes([D](auto const& q) { return WendlandC2::w(D, q); });
    expect_the_same_on_lanes([D](auto const& q) { return WendlandC2::dw(D, q); });
  }
}

/// Sources that only fill up a list lie far away; they must add nothing, and no infinity.
TEST(KernelsOnLanes, VanishExactlyFarAway) {
  for (double const q : {2.0, 2.5, 1e20, 1e150}) {
    EXPECT_EQ(lane(CubicSpline::w(Lanes(q)), 0), 0);
    EXPECT_EQ(lane(CubicSpline::dw(Lanes(q)), 0), 0);
    for (int D = 1; D <= 3; ++D) {
      EXPECT_EQ(lane(WendlandC2::w(D, Lanes(q)), 0), 0);
      EXPECT_EQ(lane(WendlandC2::dw(D, Lanes(q)), 0), 0);
    }
  }
}

}  // namespace
}  // namespace piola::inline PIOLA_BACKEND
