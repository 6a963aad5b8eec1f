// SPDX-License-Identifier: Apache-2.0
#include "piola/math/stretch.hpp"
#include "math/random.hpp"
#include <algorithm>
#include <gtest/gtest.h>

namespace piola {
namespace {

using testing::diagonal;
using testing::Random;

/// An eigenvalue that comes from the invariants: where the two smaller stretches meet, r = 1 - O(gap^2), and the
/// rounding of r, a few 1e-16 c / spread, is felt as its root times the spread. With a gap it is round-off again.
void expect_smallest(Mat<3> const& F, double smallest, double middle, double largest) {
  double const a = smallest * smallest, b = middle * middle, c = largest * largest;
  double const gap = c > a ? (b - a) / (c - a) : 0;
  EXPECT_NEAR(smallest_stretch_squared(F), a, gap > 0.05 ? 1e-12 * c : 2e-14 * c + std::sqrt(1e-14 * c * (c - a)));
}

TEST(SmallestStretch, OfTheIdentityIsOne) { EXPECT_EQ(smallest_stretch_squared(identity<3>()), 1); }

TEST(SmallestStretch, OfARotationIsOne) {
  Random random(1);
  for (int k = 0; k < 100; ++k) expect_smallest(random.rotation(), 1, 1, 1);
}

TEST(SmallestStretch, OfThreeEqualStretchesIsTheirCommonValue) {
  Random random(2);
  for (double const l : {0.1, 0.5, 1.0, 3.0}) expect_smallest(random.rotation() * diagonal(l, l, l), l, l, l);
}

TEST(SmallestStretch, OfTwoEqualStretchesIsFoundWhicheverIsSmaller) {
  Random random(3);
  for (double const l : {0.2, 0.9, 0.999999, 1.000001, 1.1, 4.0}) {
    Mat<3> const Q = random.rotation(), R = random.rotation();
    expect_smallest(Q * diagonal(1, l, 1) * transpose(R), std::min(1.0, l), 1, std::max(1.0, l));
    expect_smallest(Q * diagonal(l, 1, l) * transpose(R), std::min(1.0, l), l, std::max(1.0, l));
  }
}

TEST(SmallestStretch, OfTenThousandRandomDeformationsIsTheSmallestOfTheirStretches) {
  Random random(4);
  for (int k = 0; k < 10000; ++k) {
    double l[3] = {random.in(0.05, 3), random.in(0.05, 3), random.in(0.05, 3)};
    Mat<3> const F = random.rotation() * diagonal(l[0], l[1], l[2]) * random.rotation();
    std::sort(l, l + 3);
    expect_smallest(F, l[0], l[1], l[2]);
  }
}

TEST(SmallestStretch, OfAFlattenedParticleIsNearZero) {
  Random random(5);
  for (double const flat : {1e-3, 1e-6, 0.0}) {
    Mat<3> const F = random.rotation() * diagonal(1, flat, 2) * random.rotation();
    expect_smallest(F, flat, 1, 2);
  }
}

TEST(SmallestStretch, IsPositiveAndFiniteForTinyStrains) {
  for (double const e : {1e-8, 1e-12, 1e-15}) {
    double const s = smallest_stretch_squared(diagonal(1 + e, 1, 1 - e));
    EXPECT_NEAR(s, 1 - 2 * e, 4e-16 + 1e-6 * e);  // q - p(1 + d): p carries the strain to single accuracy at least
  }
}

}  // namespace
}  // namespace piola
