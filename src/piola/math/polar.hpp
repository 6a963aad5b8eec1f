// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/scalar.hpp"
#include "piola/math/tensor.hpp"

namespace piola::inline PIOLA_BACKEND {

/// The rotation R of the polar decomposition F = R U, det F > 0, by Newton's method with scaling: X <- (g X + X^-T / g)
/// / 2, g^2 = |X^-1| / |X| (Higham, SIAM J. Sci. Stat. Comput. 7, 1986). T is double or lanes.
template <class T>
PIOLA_FN Mat<3, T> rotation_of(Mat<3, T> const& F) {
  constexpr int most = 20;
  constexpr double converged = 1e-24;  // square of the last change: the next one is below round-off
  Mat<3, T> X = F;
  for (int k = 0; k < most; ++k) {
    Mat<3, T> const inverse_transposed = (1.0 / determinant(X)) * cofactor(X);
    T const g = square_root(square_root(contract(inverse_transposed, inverse_transposed) / contract(X, X)));
    Mat<3, T> const next = 0.5 * (g * X + (1.0 / g) * inverse_transposed), change = next - X;
    X = next;
    if (!any(contract(change, change) > converged)) break;
  }
  return X;
}

/// U = sym R^T F of that decomposition.
template <class T>
PIOLA_FN SymMat<3, T> stretch_of(Mat<3, T> const& R, Mat<3, T> const& F) {
  Mat<3, T> const A = transpose(R) * F;
  SymMat<3, T> U;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) U(i, j) = 0.5 * (A(i, j) + A(j, i));
  return U;
}

}  // namespace piola::inline PIOLA_BACKEND
