// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/passes.hpp"

/// The matrix of the divergence theorem, by the loops of the step. Theory: docs/theory/nodal.md, section 3.3.
namespace piola::nodal::inline PIOLA_BACKEND {

/// Turns the sums of x over neighbours into the least-squares quadratic c_a about each particle, itself included. Then
/// (M x)_b = sum_a s V_a (x_b - c_a.P(X_b - X_a)), a = b included: rows Y_a = V_a c_a give the sum over neighbours; the
/// part of b itself is stored in `a`.
template <int D>
struct ProjectQuadratic {
  static constexpr int values = Quadratic<D>::values, used = Records<D>::used, width = Records<D>::width;
  ReferenceView inverse, V;
  View weights, x;
  WriteView coefficients, stress, a;

  PIOLA_FN void operator()(Index i, exec::Scratch const& in) const {
    Lanes const volume = V.scalar<Lanes>(i), own = weights.scalar<Lanes>(i, 0), all = weights.scalar<Lanes>(i, 1);
    LanesOfField const entries = lanes_of(inverse, i);
    Lanes T[D][values];
    for (int c = 0; c < D; ++c)
      for (int m = 0; m < values; ++m) T[c][m] = load<Lanes>(in.at(i, c * used + m));
    Lanes found[D][width];
    for (int m = 0; m < values; ++m) {
      for (int c = 0; c < D; ++c) found[c][m] = m == 0 ? x.scalar<Lanes>(i, c) : Lanes(0.0);
      for (int n = 0; n < values; ++n) {
        Lanes const e = entries[entry(m, n)];
        for (int c = 0; c < D; ++c) found[c][m] = found[c][m] + e * T[c][n];
      }
    }
    for (int c = 0; c < D; ++c) {
      a.scalar(i, Lanes(all * x.scalar<Lanes>(i, c) - own * found[c][0]), c);
      for (int m = 0; m < values; ++m) {
        coefficients.scalar(i, found[c][m], m * D + c);
        found[c][m] = volume * found[c][m];
      }
      for (int m = values; m < width; ++m) found[c][m] = Lanes(0.0);
      put_row<D>(stress, i, c, found[c]);
    }
  }

 private:
  /// Index of an entry of a symmetric matrix in its upper triangle, row by row.
  static constexpr int entry(int m, int n) {
    int const row = m < n ? m : n, column = m < n ? n : m;
    return row * values - row * (row - 1) / 2 + column - row;
  }
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
