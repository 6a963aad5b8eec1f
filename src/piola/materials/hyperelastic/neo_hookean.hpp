// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/hyperelastic/volumetric_split.hpp"
#include "piola/math/tensor.hpp"
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Nearly incompressible neo-Hookean solid: isochoric shear part and quadratic volumetric part.
///   W = mu/2 (J^(-2/3) F:F - 3) + kappa/2 (J - 1)^2
///   P = mu J^(-2/3) (F - (F:F)/(3J) H) + p H,   p = kappa (J - 1)
/// (Lee et al. 2016, Section 2.1 with xi = 0, zeta = mu/2; eqs. 9-12.) Pressure is positive in tension. Valid for J >
/// 0.
struct NeoHookean : VolumetricSplit<NeoHookean> {
  static constexpr std::string_view name = "neo_hookean";
  static constexpr std::string_view about = "nearly incompressible neo-Hookean solid, large elastic strain";
  static constexpr std::string_view validity = "rubber, nearly incompressible, J > 0";
  static constexpr bool small_strain = false;
  using VolumetricSplit::VolumetricSplit;

  using VolumetricSplit::isochoric_energy;
  using VolumetricSplit::stress_with_pressure;
  /// P of F, H and J as unknowns (eq. 12) with the pressure p given.
  template <class T>
  PIOLA_INLINE_FN Mat<3, T> stress_with_pressure(Mat<3, T> const& F, Mat<3, T> const& H, T const& J, T const& p) const {
    T const a = power_minus_third(J);
    T const shear = mu * (a * a);
    T const along_H = p - shear * contract(F, F) / (3.0 * J);
    return shear * F + along_H * H;
  }
  /// The part of the energy that a change of volume alone does not touch.
  template <class T>
  PIOLA_INLINE_FN T isochoric_energy(Mat<3, T> const& F, Mat<3, T> const&, T const& J) const {
    T const a = power_minus_third(J);
    return 0.5 * mu * (a * a * contract(F, F) - 3.0);
  }
  /// d2W / dl_1^2, from the squares of the principal stretches [Pa].
  template <class T>
  PIOLA_FN T modulus(T const& a, T const& b, T const& c) const {
    T const area = b * c, shear = power_minus_third(a * area);  // J^(-2/3)
    return kappa * area + (0.5 * mu) * shear * (4.0 / 9.0 + (10.0 / 9.0) * (b + c) / a);
  }
};

}  // namespace piola::inline PIOLA_BACKEND
