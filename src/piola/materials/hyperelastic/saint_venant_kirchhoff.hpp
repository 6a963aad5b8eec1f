// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/elastic_constants.hpp"
#include "piola/math/tensor.hpp"
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Saint Venant-Kirchhoff solid: linear elasticity in the Green strain E = (F^T F - I)/2.
///   W = lambda/2 (tr E)^2 + mu E:E
///   P = F (lambda tr E I + 2 mu E)
/// (Bonet, Gil, Wood, Nonlinear Solid Mechanics for Finite Element Analysis: Statics, 2016, Section 6.4.) For large
/// rotation and small or moderate strain: under compression the law softens and gives way below a stretch of about 0.6.
/// The energy is a function of F alone: evolved H and J do not enter.
struct SaintVenantKirchhoff : ElasticConstants {
  static constexpr std::string_view name = "saint_venant_kirchhoff";
  static constexpr std::string_view about = "linear elasticity in the Green strain, large rotation and moderate strain";
  static constexpr std::string_view validity = "large rotation, moderate strain: stretches above 0.6";
  static constexpr bool small_strain = false;
  static constexpr bool volumetric_split = false;
  using ElasticConstants::ElasticConstants;

  /// P(F) [Pa].
  template <class T>
  PIOLA_INLINE_FN Mat<3, T> first_piola(Mat<3, T> const& F) const {
    Mat<3, T> S = green_strain(F);
    T const volume = lambda * trace(S);
    S = (2.0 * mu) * S;
    for (int i = 0; i < 3; ++i) S(i, i) = S(i, i) + volume;
    return F * S;
  }
  /// As first_piola(): H and J have no energy of their own.
  template <class T>
  PIOLA_INLINE_FN Mat<3, T> stress(Mat<3, T> const& F, Mat<3, T> const&, T const&) const {
    return first_piola(F);
  }
  /// Stored energy per reference volume [J/m^3].
  template <class T>
  PIOLA_INLINE_FN T energy(Mat<3, T> const& F) const {
    Mat<3, T> const E = green_strain(F);
    T const volume = trace(E);
    return 0.5 * lambda * (volume * volume) + mu * contract(E, E);
  }
  template <class T>
  PIOLA_INLINE_FN T energy(Mat<3, T> const& F, Mat<3, T> const&, T const&) const {
    return energy(F);
  }
  /// Mean Cauchy stress, positive in tension [Pa].
  template <class T>
  PIOLA_INLINE_FN T pressure(Mat<3, T> const& F) const {
    return contract(first_piola(F), F) / (3.0 * determinant(F));
  }
  /// Largest d2W / dl_i^2 = lambda tr E + (lambda + 3 mu) l_i^2 - mu, from the squares of the principal stretches [Pa].
  template <class T>
  PIOLA_FN T largest_modulus(T const& a, T const& b, T const& c) const {
    return 0.5 * lambda * (a + b + c - 3.0) + (lambda + 3.0 * mu) * maximum(a, maximum(b, c)) - mu;
  }

 private:
  template <class T>
  PIOLA_INLINE_FN static Mat<3, T> green_strain(Mat<3, T> const& F) {
    return 0.5 * (transpose(F) * F - identity<3, T>());
  }
};

}  // namespace piola::inline PIOLA_BACKEND
