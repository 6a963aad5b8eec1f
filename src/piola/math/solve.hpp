// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/scalar.hpp"

namespace piola::inline PIOLA_BACKEND {

/// Solves A x = b for a small dense system by Gaussian elimination with partial pivoting; A (row by row) and b are
/// overwritten, b becomes x. Returns the ratio of the smallest to the largest pivot, 0 for a singular system (b is then
/// meaningless): the caller decides what ratio is too small.
template <int N>
PIOLA_FN double solve_in_place(double (&A)[N * N], double (&b)[N]) {
  double smallest = 0, largest = 0;
  for (int k = 0; k < N; ++k) {
    int pivot = k;
    for (int i = k + 1; i < N; ++i)
      if (std::fabs(A[i * N + k]) > std::fabs(A[pivot * N + k])) pivot = i;
    double const size = std::fabs(A[pivot * N + k]);
    if (!(size > 0)) return 0;
    smallest = k == 0 || size < smallest ? size : smallest;
    largest = size > largest ? size : largest;
    for (int j = 0; j < N && pivot != k; ++j) {
      double const swap = A[k * N + j];
      A[k * N + j] = A[pivot * N + j];
      A[pivot * N + j] = swap;
    }
    double const swap = b[k];
    b[k] = b[pivot];
    b[pivot] = swap;
    for (int i = k + 1; i < N; ++i) {
      double const factor = A[i * N + k] / A[k * N + k];
      for (int j = k; j < N; ++j) A[i * N + j] -= factor * A[k * N + j];
      b[i] -= factor * b[k];
    }
  }
  for (int k = N - 1; k >= 0; --k) {
    for (int j = k + 1; j < N; ++j) b[k] -= A[k * N + j] * b[j];
    b[k] /= A[k * N + k];
  }
  return smallest / largest;
}

/// The inverse of a matrix (row by row), column by column; returns what solve_in_place does, for the worst column.
template <int N>
PIOLA_FN double invert(double const (&A)[N * N], double (&inverse)[N * N]) {
  double worst = 1;
  for (int column = 0; column < N; ++column) {
    double copy[N * N], b[N];
    for (int k = 0; k < N * N; ++k) copy[k] = A[k];
    for (int i = 0; i < N; ++i) b[i] = i == column ? 1 : 0;
    double const ratio = solve_in_place<N>(copy, b);
    worst = ratio < worst ? ratio : worst;
    for (int i = 0; i < N; ++i) inverse[i * N + column] = b[i];
  }
  return worst;
}

}  // namespace piola::inline PIOLA_BACKEND
