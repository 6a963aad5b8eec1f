// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/elastic_constants.hpp"
#include "piola/math/tensor.hpp"

namespace piola::inline PIOLA_BACKEND {

/// Laws whose energy is an isochoric part plus kappa/2 (J - 1)^2 (Lee et al. 2016, Section 2.1). A law provides
/// `small_strain`, isochoric_energy(F, H, J) with F, H and J as independent variables, stress_with_pressure(F, H, J, p)
/// with the pressure given, and modulus(a, b, c); the rest follows here. Schemes with a pressure from elsewhere (an
/// evolved or filtered J) call these functions directly.
template <class Law>
struct VolumetricSplit : ElasticConstants {
  using ElasticConstants::ElasticConstants;
  using ElasticConstants::parameters;

  static constexpr bool volumetric_split = true;

  /// Volume ratio that the volumetric energy sees.
  template <class T>
  PIOLA_INLINE_FN T volume_ratio(Mat<3, T> const& F) const {
    return volume_ratio_of(Law::small_strain, F);
  }
  /// Largest d2W / dl_i^2 over the principal stretches, from their squares [Pa]: the modulus of the fastest pressure
  /// wave in a principal direction.
  template <class T>
  PIOLA_FN T largest_modulus(T const& a, T const& b, T const& c) const {
    return maximum(law().modulus(a, b, c), maximum(law().modulus(b, c, a), law().modulus(c, a, b)));
  }
  /// p = kappa (J - 1), positive in tension (eq. 11) [Pa].
  template <class T>
  PIOLA_INLINE_FN T pressure(Mat<3, T> const& F) const {
    return kappa * (volume_ratio(F) - 1.0);
  }
  template <class T>
  PIOLA_INLINE_FN Mat<3, T> stress_with_pressure(Mat<3, T> const& F, T const& p) const {
    Mat<3, T> const H = cofactor(F);
    T const J = F(0, 0) * H(0, 0) + F(0, 1) * H(0, 1) + F(0, 2) * H(0, 2);
    return law().stress_with_pressure(F, H, J, p);
  }
  template <class T>
  PIOLA_INLINE_FN T isochoric_energy(Mat<3, T> const& F) const {
    return law().isochoric_energy(F, cofactor(F), determinant(F));
  }
  /// P of F, H and J as unknowns of their own (eq. 12) [Pa].
  template <class T>
  PIOLA_INLINE_FN Mat<3, T> stress(Mat<3, T> const& F, Mat<3, T> const& H, T const& J) const {
    return law().stress_with_pressure(F, H, J, kappa * (J - 1.0));
  }
  /// Stored energy per reference volume of F, H and J as unknowns of their own [J/m^3].
  template <class T>
  PIOLA_INLINE_FN T energy(Mat<3, T> const& F, Mat<3, T> const& H, T const& J) const {
    return law().isochoric_energy(F, H, J) + 0.5 * kappa * ((J - 1.0) * (J - 1.0));
  }
  /// P(F) [Pa] with the pressure of the same F.
  template <class T>
  PIOLA_INLINE_FN Mat<3, T> first_piola(Mat<3, T> const& F) const {
    return law().stress_with_pressure(F, pressure(F));
  }
  /// Stored energy per reference volume [J/m^3].
  template <class T>
  PIOLA_INLINE_FN T energy(Mat<3, T> const& F) const {
    T const change = volume_ratio(F) - 1.0;
    return law().isochoric_energy(F) + 0.5 * kappa * (change * change);
  }

 private:
  PIOLA_INLINE_FN Law const& law() const { return static_cast<Law const&>(*this); }
};

}  // namespace piola::inline PIOLA_BACKEND
