// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/quadratic.hpp"
#include "piola/math/embedding.hpp"
#include "piola/math/lanes.hpp"

namespace piola::nodal::inline PIOLA_BACKEND {

/// Gradients at the points of a cell, F_q = F + H.z_q.
template <int D>
struct CellPoints {
  static constexpr int points = Quadratic<D>::points;
  Mat<D, Lanes> F;
  Mat<D, Lanes> along[D];  ///< H.(L e_m)
  Lanes hoop[3];           ///< 2D: mean stretch of the third direction, and its change along the t_m

  PIOLA_INLINE_FN Mat<D, Lanes> at(int q) const {
    Mat<D, Lanes> r = F;
    for (int m = 0; m < D; ++m) r = Quadratic<D>::point(q, m) > 0 ? r + along[m] : r - along[m];
    return r;
  }
  /// In three dimensions. Missing directions do not stretch, except the hoop direction of axisymmetric bodies.
  PIOLA_INLINE_FN Mat<3, Lanes> whole_at(int q) const {
    Mat<3, Lanes> r = embed<D>(at(q));
    if constexpr (D == 2) r(2, 2) = hoop[0] + Quadratic<D>::point(q, 0) * hoop[1] + Quadratic<D>::point(q, 1) * hoop[2];
    return r;
  }
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
