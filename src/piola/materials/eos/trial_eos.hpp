// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/base/parameter.hpp"
#include "piola/math/lanes.hpp"
#include <array>
#include <string_view>
#include <type_traits>

namespace piola::inline PIOLA_BACKEND {

/// A trial: p = K (rho/rho0 - 1) + g rho e.
class TrialEos {
 public:
  static constexpr std::string_view name = "trial_eos";
  static constexpr std::array parameters{Parameter{"trial_gamma", "1", "g of the trial", not_negative, 0}};

  PIOLA_FN TrialEos(double density, double bulk_modulus, double const* v)
      : rho0_(density), kappa_(bulk_modulus), g_(v[0]) {}
  /// Pressure, positive in compression [Pa]. rho: density [kg/m^3], e: specific energy [J/kg].
  template <class V = double>
  PIOLA_FN V pressure(std::type_identity_t<V> const& rho, std::type_identity_t<V> const& e) const {
    return kappa_ * (rho / rho0_ - 1.0) + g_ * rho * e;
  }
  /// dp/drho + (p/rho^2) dp/de, the square of the isentropic sound speed [m^2/s^2].
  template <class V = double>
  PIOLA_FN V sound_speed_squared(std::type_identity_t<V> const& rho, std::type_identity_t<V> const& e) const {
    return kappa_ / rho0_ + g_ * e + pressure<V>(rho, e) / rho * g_;
  }
  /// Bulk modulus at rest [Pa].
  PIOLA_FN double bulk_modulus() const { return kappa_; }

 private:
  double rho0_, kappa_, g_;
};

}  // namespace piola::inline PIOLA_BACKEND
