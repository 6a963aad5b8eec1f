// SPDX-License-Identifier: Apache-2.0
#include "piola/math/symmetric_eigen.hpp"
#include "math/random.hpp"
#include <algorithm>
#include <gtest/gtest.h>

namespace piola {
namespace {

using testing::Random;

/// A few rotations of numbers of size 1, each rounded.
constexpr double round_off = 1e-14;

template <int D>
SymMat<D> random_tensor(Random& random) {
  SymMat<D> A;
  for (double& c : A.c) c = random.in(-1, 1);
  return A;
}

template <int D>
void expect_eigen(SymMat<D> const& A) {
  Eigen<D> const e = symmetric_eigen(A);
  for (int k = 0; k < D; ++k) {
    for (int l = 0; l < D; ++l) EXPECT_NEAR(dot(e.vector[k], e.vector[l]), k == l ? 1 : 0, round_off);
    for (int i = 0; i < D; ++i) {
      double image = 0;
      for (int j = 0; j < D; ++j) image += A(i, j) * e.vector[k][j];
      EXPECT_NEAR(image, e.value[k] * e.vector[k][i], round_off);
    }
  }
}

template <int D>
void expect_eigen_of_random_tensors(std::uint32_t seed) {
  Random random(seed);
  for (int k = 0; k < 200; ++k) expect_eigen(random_tensor<D>(random));
}

TEST(SymmetricEigen, GivesOrthonormalVectorsThatTheTensorOnlyStretches) {
  expect_eigen_of_random_tensors<1>(1);
  expect_eigen_of_random_tensors<2>(2);
  expect_eigen_of_random_tensors<3>(3);
}

template <int D>
std::array<double, D> sorted_values(SymMat<D> const& A) {
  Eigen<D> const e = symmetric_eigen(A);
  std::array<double, D> r;
  std::copy_n(e.value, D, r.begin());
  std::sort(r.begin(), r.end());
  return r;
}

TEST(SymmetricEigen, HasTheValuesOfClosedForms) {
  auto const two = sorted_values<2>({{2, 2, 1}});  // 2 +- 1
  EXPECT_NEAR(two[0], 1, round_off);
  EXPECT_NEAR(two[1], 3, round_off);
  auto const three = sorted_values<3>({{2, 2, 2, 1, 1, 0}});  // 2, 2 +- sqrt 2: a chain of two springs
  EXPECT_NEAR(three[0], 2 - std::sqrt(2.0), round_off);
  EXPECT_NEAR(three[1], 2, round_off);
  EXPECT_NEAR(three[2], 2 + std::sqrt(2.0), round_off);
}

TEST(SymmetricEigen, OfRepeatedValuesIsStillAnOrthonormalFrame) {
  expect_eigen<2>({{3, 3, 0}});
  expect_eigen<3>({{1, 1, 1, 0, 0, 0}});
  expect_eigen<3>({{0, 0, 0, 0, 0, 0}});
  // a (x) a: one value 1, two of 0.
  double const a[3] = {2.0 / 3, -1.0 / 3, 2.0 / 3};
  SymMat<3> A;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) A(i, j) = a[i] * a[j];
  expect_eigen(A);
  auto const values = sorted_values(A);
  EXPECT_NEAR(values[0], 0, round_off);
  EXPECT_NEAR(values[1], 0, round_off);
  EXPECT_NEAR(values[2], 1, round_off);
}

TEST(SymmetricEigen, DoesNotDependOnTheScale) {
  Random random(4);
  for (double const scale : {1e-60, 1e-12, 1e12, 1e60}) {
    SymMat<3> A = random_tensor<3>(random), scaled = A;
    for (double& c : scaled.c) c *= scale;
    auto const one = sorted_values(A), other = sorted_values(scaled);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(other[k] / scale, one[k], 1e-14) << scale;
  }
}

}  // namespace
}  // namespace piola
