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

  PIOLA_INLINE_FN Mat<D, Lanes> at(int q) const {
    Mat<D, Lanes> r = F;
    for (int m = 0; m < D; ++m) r = Quadratic<D>::point(q, m) > 0 ? r + along[m] : r - along[m];
    return r;
  }
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
