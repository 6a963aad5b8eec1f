// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"

/// Kinematic embeddings: laws are three-dimensional, one- and two-dimensional bodies are assumptions about the missing
/// directions. Uniaxial strain (1D) and plane strain (2D): missing directions do not stretch.
namespace piola::inline PIOLA_MACHINE {

/// F of a D-dimensional body as a 3D deformation gradient.
template <int D, class T>
PIOLA_FN Mat<3, T> embed(Mat<D, T> const& F) {
  if constexpr (D == 3) return F;
  Mat<3, T> r = identity<3, T>();
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) r(i, j) = F(i, j);
  return r;
}

/// A rate of F: missing directions do not stretch.
template <int D, class T>
PIOLA_FN Mat<3, T> embed_rate(Mat<D, T> const& F_dot) {
  if constexpr (D == 3) return F_dot;
  Mat<3, T> r;
  for (int c = 0; c < 9; ++c) r.c[c] = T(0.0);
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) r(i, j) = F_dot(i, j);
  return r;
}

/// The components of a 3D stress that do work on a D-dimensional motion.
template <int D, class T>
PIOLA_FN Mat<D, T> restrict_to(Mat<3, T> const& P) {
  Mat<D, T> r;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) r(i, j) = P(i, j);
  return r;
}

}  // namespace piola::inline PIOLA_MACHINE
