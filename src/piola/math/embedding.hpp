// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"

/// Kinematic embeddings: laws are three-dimensional, one- and two-dimensional bodies are assumptions about the missing
/// directions. Uniaxial strain (1D) and plane strain (2D): missing directions do not stretch.
namespace piola::inline PIOLA_BACKEND {

/// `rest` with the D x D corner of F.
template <int D, class T>
PIOLA_INLINE_FN Mat<3, T> with_corner(Mat<3, T> rest, Mat<D, T> const& F) {
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) rest(i, j) = F(i, j);
  return rest;
}

/// F of a D-dimensional body as a 3D deformation gradient.
template <int D, class T>
PIOLA_INLINE_FN Mat<3, T> embed(Mat<D, T> const& F) {
  if constexpr (D == 3) return F;
  return with_corner<D>(identity<3, T>(), F);
}

/// A rate of F: missing directions do not stretch.
template <int D, class T>
PIOLA_INLINE_FN Mat<3, T> embed_rate(Mat<D, T> const& F_dot) {
  if constexpr (D == 3) return F_dot;
  return with_corner<D>(0.0 * identity<3, T>(), F_dot);
}

/// The components of a 3D stress that do work on a D-dimensional motion.
template <int D, class T>
PIOLA_INLINE_FN Mat<D, T> restrict_to(Mat<3, T> const& P) {
  Mat<D, T> r;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) r(i, j) = P(i, j);
  return r;
}

}  // namespace piola::inline PIOLA_BACKEND
