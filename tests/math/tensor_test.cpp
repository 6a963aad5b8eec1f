// SPDX-License-Identifier: Apache-2.0
#include "piola/math/tensor.hpp"
#include "piola/math/embedding.hpp"
#include "math/random.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using testing::Random;
using testing::size;

/// Products of three components below 2 in size: a few dozen roundings of numbers up to 48.
constexpr double round_off = 1e-13;

/// Sign of the permutation (i, j, k) of (0, 1, 2); 0 if two are equal.
int epsilon(int i, int j, int k) { return (i - j) * (j - k) * (k - i) / 2; }

TEST(Tensor, ProductOfAMatrixAndItsInverseIsTheIdentity) {
  Random random(1);
  for (int k = 0; k < 100; ++k) {
    Mat<3> const A = testing::diagonal(2, -2, 3) + random.matrix(0.5);
    EXPECT_LT(size(A * inverse(A) - identity<3>()), round_off);
  }
}

template <int D>
void expect_inverse(Mat<D> const& A) {
  Mat<D> const product = A * inverse(A), reverse = inverse(A) * A;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      EXPECT_NEAR(product(i, j), i == j ? 1 : 0, round_off);
      EXPECT_NEAR(reverse(i, j), i == j ? 1 : 0, round_off);
    }
}

TEST(Tensor, OfOneAndTwoDimensionsHasAnInverse) {
  EXPECT_EQ(inverse(Mat<1>{{-4}}).c[0], -0.25);
  Mat<2> const known = inverse(Mat<2>{{1, 2, 3, 4}});  // det -2
  double const expected[] = {-2, 1, 1.5, -0.5};
  for (int k = 0; k < 4; ++k) EXPECT_EQ(known.c[k], expected[k]);
  Random random(11);
  for (int k = 0; k < 100; ++k) {
    expect_inverse<1>({{random.in(0.1, 2)}});
    expect_inverse<2>({{2 + random.in(-0.5, 0.5), random.in(-1, 1), random.in(-1, 1), -2 + random.in(-0.5, 0.5)}});
  }
}

TEST(Tensor, CofactorIsTheDeterminantTimesTheTransposedInverse) {
  Mat<3> const A{{1, 2, 3, 0, 1, 4, 5, 6, 0}};  // det 1, inverse known in integers
  Mat<3> const inverse_transposed{{-24, 20, -5, 18, -15, 4, 5, -4, 1}};
  EXPECT_EQ(determinant(A), 1);
  EXPECT_EQ(size(cofactor(A) - inverse_transposed), 0);
}

TEST(Tensor, CrossProductOfTensorsFollowsItsDefinitionWithPermutations) {
  Random random(2);
  Mat<3> const A = random.matrix(2), B = random.matrix(2), product = tensor_cross(A, B);
  for (int i = 0; i < 3; ++i)
    for (int I = 0; I < 3; ++I) {
      double sum = 0;
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          for (int J = 0; J < 3; ++J)
            for (int K = 0; K < 3; ++K) sum += epsilon(i, j, k) * epsilon(I, J, K) * A(j, J) * B(k, K);
      EXPECT_NEAR(product(i, I), sum, round_off);
    }
}

TEST(Tensor, HalfTheCrossProductWithItselfIsTheCofactor) {
  Random random(3);
  for (int k = 0; k < 100; ++k) {
    Mat<3> const F = random.matrix(2);
    EXPECT_LT(size(0.5 * tensor_cross(F, F) - cofactor(F)), round_off);
  }
}

TEST(Tensor, AThirdOfTheCofactorContractedWithTheTensorIsTheDeterminant) {
  Random random(4);
  for (int k = 0; k < 100; ++k) {
    Mat<3> const F = random.matrix(2);
    EXPECT_NEAR(contract(cofactor(F), F) / 3, determinant(F), round_off);
  }
}

TEST(Tensor, CrossProductIsSymmetricAndLinear) {
  Random random(5);
  Mat<3> const A = random.matrix(2), B = random.matrix(2), C = random.matrix(2);
  EXPECT_LT(size(tensor_cross(A, B) - tensor_cross(B, A)), round_off);
  EXPECT_LT(size(tensor_cross(A, B + 2.0 * C) - tensor_cross(A, B) - 2.0 * tensor_cross(A, C)), round_off);
}

TEST(Tensor, DeterminantIsMultiplicativeAndOneForRotations) {
  Random random(6);
  for (int k = 0; k < 100; ++k) {
    Mat<3> const A = random.matrix(2), B = random.matrix(2), Q = random.rotation();
    EXPECT_NEAR(determinant(A * B), determinant(A) * determinant(B), 1e-11);  // terms up to 12^3
    EXPECT_NEAR(determinant(Q), 1, round_off);
    EXPECT_LT(size(Q * transpose(Q) - identity<3>()), round_off);
  }
}

TEST(Tensor, OuterProductMapsAlongItsFirstVector) {
  Random random(7);
  Vec<3> const a = random.vector(2), b = random.vector(2), c = random.vector(2);
  Vec<3> const mapped = outer(a, b) * c;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(mapped[i], a[i] * dot(b, c), round_off);
  EXPECT_NEAR(trace(outer(a, b)), dot(a, b), round_off);
}

TEST(Tensor, CrossProductOfVectorsIsNormalToBothAndRightHanded) {
  Vec<3> const z = cross(Vec<3>{{1, 0, 0}}, Vec<3>{{0, 1, 0}});
  EXPECT_EQ(z[0], 0);
  EXPECT_EQ(z[1], 0);
  EXPECT_EQ(z[2], 1);
}

TEST(Tensor, SymmetricTensorIsStoredDiagonalFirst) {
  SymMat<3> S;
  for (int k = 0; k < 6; ++k) S.c[k] = k;
  EXPECT_EQ(S(0, 0), 0);
  EXPECT_EQ(S(1, 1), 1);
  EXPECT_EQ(S(2, 2), 2);
  EXPECT_EQ(S(0, 1), 3);
  EXPECT_EQ(S(1, 2), 4);
  EXPECT_EQ(S(2, 0), 5);
  SymMat<2> plane;
  for (int k = 0; k < 3; ++k) plane.c[k] = k;
  EXPECT_EQ(plane(0, 1), 2);
  EXPECT_EQ(plane(1, 0), 2);
}

TEST(Tensor, ProductWithASymmetricTensorIsThatWithItsFullMatrix) {
  SymMat<3> S;
  Mat<3> full;
  for (int k = 0; k < 6; ++k) S.c[k] = 1 + k;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) full(i, j) = S(i, j);
  Mat<3> const A{{1, 2, 3, 4, 5, 6, 7, 8, 10}};
  EXPECT_EQ(size(A * S - A * full), 0);
}

TEST(Embedding, MissingDirectionsDoNotStretch) {
  Mat<3> const bar = embed<1>(Mat<1>{{1.5}});
  EXPECT_EQ(size(bar - testing::diagonal(1.5, 1, 1)), 0);
  Mat<3> const plate = embed<2>(Mat<2>{{1.5, 0.25, -0.25, 0.75}});
  EXPECT_EQ(size(plate - Mat<3>{{1.5, 0.25, 0, -0.25, 0.75, 0, 0, 0, 1}}), 0);
}

TEST(Embedding, RestrictionKeepsTheLeadingComponents) {
  Mat<3> const P{{1, 2, 3, 4, 5, 6, 7, 8, 9}};
  Mat<2> const plate = restrict_to<2>(P);
  EXPECT_EQ(plate(0, 0), 1);
  EXPECT_EQ(plate(0, 1), 2);
  EXPECT_EQ(plate(1, 0), 4);
  EXPECT_EQ(plate(1, 1), 5);
  EXPECT_EQ(restrict_to<1>(P)(0, 0), 1);
}

}  // namespace
}  // namespace piola
