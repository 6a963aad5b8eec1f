// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include <cmath>

namespace piola::inline PIOLA_BACKEND {

/// Eigenvalues and eigenvectors of a symmetric tensor, or of one per lane.
template <int D, class V = double>
struct Eigen {
  V value[D];
  Vec<D, V> vector[D];  ///< orthonormal, vector[k] belongs to value[k]; in no particular order
};

/// Upper bound of the eigenvalues (Gershgorin): the largest sum of a diagonal component and the absolute off-diagonal
/// values of its row.
template <int D, class V>
PIOLA_INLINE_FN V eigenvalue_bound(SymMat<D, V> const& A) {
  V bound(-1e300);
  for (int i = 0; i < D; ++i) {
    V sum(0.0);
    for (int j = 0; j < D; ++j) {
      V const a = A(i, j);
      sum += i == j ? a : select(a < 0.0, -a, a);
    }
    bound = select(sum > bound, sum, bound);
  }
  return bound;
}

/// Jacobi's method: rotations in the planes of the off-diagonal components until these are round-off of the rest.
/// A lane whose tensor is diagonal enough rotates no more, so that its result does not depend on the other lanes.
template <int D, class V>
PIOLA_INLINE_FN Eigen<D, V> symmetric_eigen(SymMat<D, V> A) {
  Eigen<D, V> e;
  Mat<D, V> Q = identity<D, V>();
  for (int sweep = 0; sweep < 12; ++sweep) {  // each squares the size of what is left; three or four suffice
    V off(0.0), size(0.0);
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) (i == j ? size : off) += A(i, j) * A(i, j);
    auto const goes_on = off > 1e-34 * size;
    if (!any(goes_on)) break;
    for (int p = 0; p < D; ++p)
      for (int q = p + 1; q < D; ++q) {
        auto const rotates = goes_on && A(p, q) != 0.0;
        if (!any(rotates)) continue;
        V const theta = (A(q, q) - A(p, p)) / (2.0 * select(rotates, A(p, q), V(1.0)));
        V const size_of_theta = select(theta < 0.0, -theta, theta);
        V const tangent = select(theta >= 0.0, V(1.0), V(-1.0)) / (size_of_theta + square_root(theta * theta + 1.0));
        V const t = select(rotates, tangent, V(0.0));
        V const c = 1.0 / square_root(t * t + 1.0), s = t * c, apq = A(p, q);
        A(p, p) -= t * apq;
        A(q, q) += t * apq;
        A(p, q) = select(rotates, V(0.0), apq);
        for (int k = 0; k < D; ++k) {
          if (k != p && k != q) {
            V const kp = A(k, p), kq = A(k, q);
            A(k, p) = c * kp - s * kq;
            A(k, q) = s * kp + c * kq;
          }
          V const up = Q(k, p), uq = Q(k, q);
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

}  // namespace piola::inline PIOLA_BACKEND
