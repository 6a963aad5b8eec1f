// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/hyperelastic/neo_hookean.hpp"
#include <array>
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Kelvin-Voigt solid: the neo-Hookean stress and, in parallel, a Newtonian one of the rate of the Green strain,
///   P = P_nh(F) + F S_v,  S_v = 2 eta E_dot,  E_dot = (F^T F_dot + F_dot^T F) / 2.
/// Objective; dissipates S_v : E_dot = 2 eta E_dot : E_dot >= 0. Valid for J > 0.
struct KelvinVoigt : NeoHookean {
  static constexpr std::string_view name = "kelvin_voigt";
  static constexpr std::string_view about = "neo-Hookean solid with a Newtonian viscous stress, large strain";
  static constexpr std::array parameters{
      ElasticConstants::parameters[0], ElasticConstants::parameters[1], ElasticConstants::parameters[2],
      Parameter{"shear_viscosity", "Pa s", "viscous stress over twice the rate of the Green strain", not_negative}};

  double eta;  ///< shear viscosity [Pa s]

  /// values: density, Young's modulus, Poisson's ratio, shear_viscosity.
  PIOLA_FN explicit KelvinVoigt(double const* values) : NeoHookean(values), eta(values[3]) {}

  /// Viscous part of P [Pa] from F and its rate [1/s].
  template <class T>
  PIOLA_FN Mat<3, T> viscous_stress(Mat<3, T> const& F, Mat<3, T> const& F_dot) const {
    Mat<3, T> const half = transpose(F) * F_dot;
    return eta * (F * (half + transpose(half)));
  }
};

}  // namespace piola::inline PIOLA_BACKEND
