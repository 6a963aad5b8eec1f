// SPDX-License-Identifier: Apache-2.0
#include "piola/math/envelope_cholesky.hpp"
#include "math/random.hpp"
#include <gtest/gtest.h>
#include <vector>

namespace piola {
namespace {

using testing::Random;
using Matrix = std::vector<std::vector<double>>;

/// B B^T of rows that each have `reach` entries from their own place on.
Matrix gram(std::size_t n, std::size_t reach, Random& random) {
  Matrix B(n, std::vector<double>(n + reach, 0)), A(n, std::vector<double>(n, 0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i; k < i + reach; ++k) B[i][k] = random.in(-1, 1) + (k == i ? 2 : 0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n + reach; ++k) A[i][j] += B[i][k] * B[j][k];
  return A;
}

EnvelopeCholesky factors(Matrix const& A) {
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < A.size(); ++i) {
    std::size_t j = 0;
    while (j < i && A[i][j] == 0) ++j;
    first.push_back(j);
  }
  EnvelopeCholesky r(first);
  for (std::size_t i = 0; i < A.size(); ++i)
    for (std::size_t j = first[i]; j <= i; ++j) r.at(i, j) = A[i][j];
  r.factorise();
  return r;
}

std::vector<double> product(Matrix const& A, std::vector<double> const& x) {
  std::vector<double> b(A.size(), 0);
  for (std::size_t i = 0; i < A.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j) b[i] += A[i][j] * x[j];
  return b;
}

TEST(EnvelopeCholesky, SolvesBandedEquations) {
  Random random(3);
  for (std::size_t const reach : {1U, 3U, 20U}) {
    Matrix const A = gram(20, reach, random);
    std::vector<double> x;
    for (std::size_t k = 0; k < 20; ++k) x.push_back(random.in(-5, 5));
    auto b = product(A, x);
    auto const f = factors(A);
    EXPECT_EQ(f.rank(), 20U);
    f.solve(b);
    for (std::size_t k = 0; k < 20; ++k) EXPECT_NEAR(b[k], x[k], 1e-10);
  }
}

TEST(EnvelopeCholesky, LeavesOutEquationsThatDependOnOthers) {
  Random random(4);
  Matrix A = gram(6, 3, random);
  // Row 6 = row 1 + row 4, row 7 = row 0; the same for columns.
  auto const combined = [&](std::size_t j) { return std::vector<double>{A[1][j] + A[4][j], A[0][j]}; };
  Matrix B(8, std::vector<double>(8, 0));
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) B[i][j] = A[i][j];
  for (std::size_t j = 0; j < 6; ++j) {
    auto const rows = combined(j);
    B[6][j] = B[j][6] = rows[0];
    B[7][j] = B[j][7] = rows[1];
  }
  B[6][6] = B[6][1] + B[6][4];
  B[7][7] = B[7][0];
  B[6][7] = B[7][6] = B[6][0];
  std::vector<double> const x{1, -2, 3, 4, 5, -6, 0.5, 7};
  auto const wanted = product(B, x);
  auto solution = wanted;
  auto const f = factors(B);
  EXPECT_EQ(f.rank(), 6U);
  f.solve(solution);
  EXPECT_EQ(solution[6], 0);
  EXPECT_EQ(solution[7], 0);
  auto const again = product(B, solution);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(again[k], wanted[k], 1e-10);
}

TEST(EnvelopeCholesky, TakesAMatrixOfZeros) {
  EnvelopeCholesky f({0, 0, 0});
  f.factorise();
  std::vector<double> b{1, 2, 3};
  f.solve(b);
  EXPECT_EQ(b, (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(f.rank(), 0U);
}

}  // namespace
}  // namespace piola
