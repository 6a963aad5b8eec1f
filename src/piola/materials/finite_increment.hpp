// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include <type_traits>

/// Stresses at known deformation gradients, and the increment of those of solids in rate form between two of them. T is
/// double or lanes.
namespace piola::inline PIOLA_BACKEND {

/// J sigma F^-T [Pa], sigma = S - p I.
template <class T>
PIOLA_FN Mat<3, T> first_piola_of(SymMat<3, T> const& S, T const& pressure, Mat<3, T> const& F) {
  Mat<3, T> sigma;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sigma(i, j) = i == j ? T(S(i, j) - pressure) : S(i, j);
  return sigma * cofactor(F);
}

/// Cauchy stress (1/J) P F^T [Pa], symmetrised.
template <class T>
PIOLA_FN SymMat<3, T> cauchy_stress(Mat<3, T> const& P, Mat<3, T> const& F, std::type_identity_t<T> const& J) {
  Mat<3, T> const s = (1.0 / J) * (P * transpose(F));
  SymMat<3, T> r;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) r(i, j) = 0.5 * (s(i, j) + s(j, i));
  return r;
}

/// The trial deviator of a step: R S R^T + 2 mu dev d with l = (dF - I) ((dF + I)/2)^-1, dF = F F_n^-1, d and w its
/// parts and R = (I - w/2)^-1 (I + w/2) (Hughes, Winget, Int. J. Numer. Meth. Engng 15, 1980). Exact for rotations.
template <class T>
PIOLA_FN SymMat<3, T> trial_deviator(SymMat<3, T> const& S, double mu, Mat<3, T> const& F_n, Mat<3, T> const& F) {
  Mat<3, T> const I = identity<3, T>(), change = (F - F_n) * inverse(F_n), l = change * inverse(I + 0.5 * change);
  Mat<3, T> const half_spin = 0.25 * (l - transpose(l)), R = inverse(I - half_spin) * (I + half_spin);
  Mat<3, T> const turned = R * S * transpose(R);
  T const mean = trace(l) / 3.0;
  SymMat<3, T> trial;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      trial(i, j) =
          0.5 * (turned(i, j) + turned(j, i)) + mu * (l(i, j) + l(j, i)) - (i == j ? T(2 * mu * mean) : T(0.0));
  return trial;
}

}  // namespace piola::inline PIOLA_BACKEND
