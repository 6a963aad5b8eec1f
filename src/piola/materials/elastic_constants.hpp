// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/base/parameter.hpp"
#include "piola/math/tensor.hpp"
#include <array>
#include <cmath>

namespace piola::inline PIOLA_BACKEND {

/// The volume ratio of a law: det F, or 1 + tr e for small strain.
template <class T>
PIOLA_FN T volume_ratio_of(bool small_strain, Mat<3, T> const& F) {
  return small_strain ? trace(F) - 2.0 : determinant(F);
}

/// Isotropic elastic constants from density, Young's modulus and Poisson's ratio.
struct ElasticConstants {
  static constexpr std::array parameters{
      Parameter{"density", "kg/m^3", "mass density in the reference configuration", positive},
      Parameter{"youngs_modulus", "Pa", "Young's modulus", positive},
      Parameter{"poissons_ratio", "1", "Poisson's ratio", Interval{-1, 0.5, true, true}}};

  double rho0;    ///< reference density [kg/m^3]
  double mu;      ///< shear modulus [Pa]
  double lambda;  ///< first Lame parameter [Pa]
  double kappa;   ///< bulk modulus [Pa]

  /// values: density, Young's modulus, Poisson's ratio, in the order of `parameters`.
  PIOLA_FN explicit ElasticConstants(double const* values)
      : rho0(values[0]),
        mu(values[1] / (2 * (1 + values[2]))),
        lambda(values[2] * values[1] / ((1 + values[2]) * (1 - 2 * values[2]))),
        kappa(lambda + 2 * mu / 3) {}

  /// Speed of pressure waves at F = I [m/s].
  PIOLA_FN double p_wave_speed() const { return std::sqrt((lambda + 2 * mu) / rho0); }
  /// Speed of shear waves at F = I [m/s].
  PIOLA_FN double s_wave_speed() const { return std::sqrt(mu / rho0); }
};

}  // namespace piola::inline PIOLA_BACKEND
