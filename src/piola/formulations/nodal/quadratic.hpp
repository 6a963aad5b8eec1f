// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"

/// Quadratic polynomials about a particle, in units of the spacing: monomials and derivatives.
namespace piola::nodal::inline PIOLA_BACKEND {

/// Default support radius in spacings, enlarged if neighbours do not determine a quadratic well: 56 neighbours inside a
/// cubic lattice.
inline constexpr double usual_reach = 2.4;

/// Sizes in D dimensions. Second derivatives are in the order 11 22 33 23 13 12 (2D: 11 22 12).
template <int D>
struct Quadratic {
  static constexpr int second = D * (D + 1) / 2;  ///< second derivatives
  static constexpr int terms = D + second;        ///< without the constant
  static constexpr int values = 1 + terms;        ///< with it
  static constexpr int points = D == 3 ? 4 : 1 << D;

  /// Index of d2/dX_J dX_K among the second derivatives.
  static constexpr int at(int J, int K) { return J == K ? J : D == 2 ? 2 : 6 - J - K; }
  /// Point q of the quadrature: mean zero, covariance one; D = 3: a tetrahedron, else the corners of a square.
  static constexpr double point(int q, int m) {
    if (D < 3) return (q >> m & 1) != 0 ? 1.0 : -1.0;
    return q == 0 || m == q - 1 ? 1.0 : -1.0;
  }
};

/// p = (1; r1, ..; r1^2/2, ..; r2 r3, r1 r3, r1 r2). A quadratic field is p times its derivatives at r = 0.
template <int D, class V>
PIOLA_FN void monomials(Vec<D, V> const& r, V (&p)[Quadratic<D>::values]) {
  p[0] = V(1.0);
  for (int i = 0; i < D; ++i) {
    p[1 + i] = r[i];
    p[1 + D + i] = 0.5 * (r[i] * r[i]);
  }
  for (int i = 0; i < D; ++i)
    for (int j = i + 1; j < D; ++j) p[1 + D + Quadratic<D>::at(i, j)] = r[i] * r[j];
}

}  // namespace piola::nodal::inline PIOLA_BACKEND
