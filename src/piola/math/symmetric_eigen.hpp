// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include <cmath>

namespace piola::inline PIOLA_MACHINE {

/// Eigenvalues and eigenvectors of a symmetric tensor.
template <int D>
struct Eigen {
  double value[D];
  Vec<D> vector[D];  ///< orthonormal, vector[k] belongs to value[k]; in no particular order
};

/// No eigenvalue is above this (Gershgorin): the largest sum of a diagonal component and the absolute values beside it.
template <int D>
PIOLA_FN double eigenvalue_bound(SymMat<D> const& A) {
  double bound = -1e300;
  for (int i = 0; i < D; ++i) {
    double sum = 0;
    for (int j = 0; j < D; ++j) sum += i == j ? A(i, i) : std::fabs(A(i, j));
    bound = sum > bound ? sum : bound;
  }
  return bound;
}

/// Jacobi's method: rotations in the planes of the off-diagonal components until these are round-off of the rest.
template <int D>
PIOLA_FN Eigen<D> symmetric_eigen(SymMat<D> A) {
  Eigen<D> e;
  Mat<D> Q = identity<D>();
  constexpr int sweeps = 12;  // each squares the size of what is left; three or four suffice
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double off = 0, size = 0;
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) (i == j ? size : off) += A(i, j) * A(i, j);
    if (!(off > 1e-34 * size)) break;
    for (int p = 0; p < D; ++p)
      for (int q = p + 1; q < D; ++q) {
        if (A(p, q) == 0) continue;
        double const theta = (A(q, q) - A(p, p)) / (2 * A(p, q));
        double const t = (theta >= 0 ? 1 : -1) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
        double const c = 1 / std::sqrt(t * t + 1), s = t * c, apq = A(p, q);
        A(p, p) -= t * apq;
        A(q, q) += t * apq;
        A(p, q) = 0;
        for (int k = 0; k < D; ++k) {
          if (k != p && k != q) {
            double const kp = A(k, p), kq = A(k, q);
            A(k, p) = c * kp - s * kq;
            A(k, q) = s * kp + c * kq;
          }
          double const up = Q(k, p), uq = Q(k, q);
          Q(k, p) = c * up - s * uq;
          Q(k, q) = s * up + c * uq;
        }
      }
  }
  for (int k = 0; k < D; ++k) {
    e.value[k] = A(k, k);
    for (int i = 0; i < D; ++i) e.vector[k][i] = Q(i, k);
  }
  return e;
}

}  // namespace piola::inline PIOLA_MACHINE
