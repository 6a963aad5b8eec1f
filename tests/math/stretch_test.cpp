// SPDX-License-Identifier: Apache-2.0
#include "piola/math/stretch.hpp"
#include "math/random.hpp"
#include <algorithm>
#include <array>
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

/// Eigenvalues of a symmetric matrix, smallest first, by cyclic Jacobi rotations.
std::array<double, 3> eigenvalues(Mat<3> A) {
  for (int sweep = 0; sweep < 30; ++sweep)
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (A(p, q) == 0) continue;
        double const theta = (A(q, q) - A(p, p)) / (2 * A(p, q));
        double const t = (theta < 0 ? -1 : 1) / (std::fabs(theta) + std::hypot(theta, 1.0));
        double const cosine = 1 / std::sqrt(t * t + 1), sine = t * cosine;
        Mat<3> G = identity<3>();
        G(p, p) = G(q, q) = cosine;
        G(p, q) = sine;
        G(q, p) = -sine;
        A = transpose(G) * (A * G);
        A(p, q) = A(q, p) = 0;
      }
  std::array<double, 3> r{A(0, 0), A(1, 1), A(2, 2)};
  std::sort(r.begin(), r.end());
  return r;
}

/// All three stretches against the independent solver. Where two of them meet, the rounding of r is felt as its root.
void expect_all(Mat<3> const& F) {
  auto const expected = eigenvalues(transpose(F) * F);
  Vec<3> const found = principal_stretches_squared(F);
  double const a = expected[0], b = expected[1], c = expected[2];
  double const gap = c > a ? std::min(b - a, c - b) / (c - a) : 0;
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(found[i], expected[static_cast<std::size_t>(i)],
                gap > 0.05 ? 1e-12 * c : 2e-14 * c + std::sqrt(1e-14 * c * (c - a)));
}

TEST(PrincipalStretches, AgreeWithJacobisMethodForRandomDeformations) {
  Random random(6);
  for (int k = 0; k < 10000; ++k) {
    Mat<3> const F = identity<3>() + random.matrix(random.in(0, 1.5));
    expect_all(F);
    Vec<3> const l = principal_stretches_squared(F);
    EXPECT_LE(l[0], l[1]);
    EXPECT_LE(l[1], l[2]);
  }
}

TEST(PrincipalStretches, AgreeWithJacobisMethodForRepeatedStretches) {
  Random random(7);
  for (double const l : {0.1, 0.5, 0.999, 1.0, 1.000001, 1.1, 3.0})
    for (int k = 0; k < 20; ++k) {
      Mat<3> const Q = random.rotation(), R = transpose(random.rotation());
      expect_all(Q * diagonal(l, l, l) * R);
      expect_all(Q * diagonal(l, 1, l) * R);
      expect_all(Q * diagonal(1, l, 1) * R);
    }
}

TEST(PrincipalStretches, AgreeWithJacobisMethodForExtremeStretches) {
  Random random(8);
  for (double const l : {1e-3, 1e-2, 30.0, 1e3})
    for (int k = 0; k < 20; ++k) {
      Mat<3> const Q = random.rotation(), R = transpose(random.rotation());
      expect_all(Q * diagonal(l, 1, 2) * R);
      expect_all(Q * diagonal(l, 1, 1 / l) * R);
      expect_all(l * (Q * diagonal(0.5, 1, 2) * R));
    }
}

TEST(PrincipalStretches, HaveTheTraceOfTheStrain) {
  Random random(9);
  for (int k = 0; k < 1000; ++k) {
    Mat<3> const F = identity<3>() + random.matrix(0.8);
    Vec<3> const l = principal_stretches_squared(F);
    double const sum = contract(F, F);
    EXPECT_NEAR(l[0] + l[1] + l[2], sum, 1e-13 * sum);
  }
}

}  // namespace
}  // namespace piola
