// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/elastic_constants.hpp"
#include "piola/math/tensor.hpp"
#include <array>
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Compressible neo-Hookean solid, with the logarithm of the volume ratio.
///   W = mu/2 (F:F - 3) - mu ln J + lambda/2 (ln J)^2
///   P = mu F + ((lambda ln J - mu) / J) H
/// (Bonet, Gil, Wood, Nonlinear Solid Mechanics for Finite Element Analysis: Statics, 2016, Section 6.4.3.) For foams
/// and soft solids that change volume; polyconvex up to J = e^(1 + mu / lambda). Valid for J > 0.
struct CompressibleNeoHookean : ElasticConstants {
  static constexpr std::string_view name = "compressible_neo_hookean";
  static constexpr std::string_view about = "compressible neo-Hookean solid with ln J, large elastic strain";
  static constexpr std::string_view validity = "large strain with change of volume, Poisson's ratio from 0 on, J > 0";
  static constexpr bool small_strain = false;
  static constexpr bool volumetric_split = false;
  /// With lambda < 0 the energy would fall without limit towards J = 0.
  static constexpr std::array parameters{
      ElasticConstants::parameters[0], ElasticConstants::parameters[1],
      Parameter{"poissons_ratio", "1", "Poisson's ratio", Interval{0, 0.5, false, true}}};
  using ElasticConstants::ElasticConstants;

  /// P of F, H and J as unknowns of their own (eq. 12; S_H = 0) [Pa].
  template <class T>
  PIOLA_INLINE_FN Mat<3, T> stress(Mat<3, T> const& F, Mat<3, T> const& H, T const& J) const {
    return mu * F + T((lambda * logarithm(J) - mu) / J) * H;
  }
  /// P(F) [Pa].
  template <class T>
  PIOLA_INLINE_FN Mat<3, T> first_piola(Mat<3, T> const& F) const {
    Mat<3, T> const H = cofactor(F);
    T const J = F(0, 0) * H(0, 0) + F(0, 1) * H(0, 1) + F(0, 2) * H(0, 2);
    return stress(F, H, J);
  }
  /// Stored energy per reference volume of F, H and J as unknowns of their own [J/m^3].
  template <class T>
  PIOLA_INLINE_FN T energy(Mat<3, T> const& F, Mat<3, T> const&, T const& J) const {
    T const volume = logarithm(J);
    return (0.5 * mu) * (contract(F, F) - 3.0) + volume * (0.5 * lambda * volume - mu);
  }
  /// Stored energy per reference volume [J/m^3].
  template <class T>
  PIOLA_INLINE_FN T energy(Mat<3, T> const& F) const {
    return energy(F, F, determinant(F));
  }
  /// Mean Cauchy stress, positive in tension [Pa].
  template <class T>
  PIOLA_INLINE_FN T pressure(Mat<3, T> const& F) const {
    T const J = determinant(F);
    return (mu * ((1.0 / 3.0) * contract(F, F) - 1.0) + lambda * logarithm(J)) / J;
  }
  /// Largest d2W / dl_i^2 = mu + (mu + lambda (1 - ln J)) / l_i^2, from the squares of the principal stretches [Pa].
  template <class T>
  PIOLA_FN T largest_modulus(T const& a, T const& b, T const& c) const {
    T const volume = mu + lambda * (1.0 - 0.5 * logarithm(a * b * c));
    return mu + maximum(volume / a, maximum(volume / b, volume / c));
  }
};

}  // namespace piola::inline PIOLA_BACKEND
