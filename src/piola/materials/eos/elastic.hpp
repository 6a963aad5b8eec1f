// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/base/parameter.hpp"
#include "piola/math/lanes.hpp"
#include <array>
#include <string_view>
#include <type_traits>

namespace piola::inline PIOLA_BACKEND {

/// Pressure that is linear in the density and independent of energy: p = K (rho/rho0 - 1).
class ElasticEos {
 public:
  static constexpr std::string_view name = "elastic";
  static constexpr std::array<Parameter, 0> parameters{};

  PIOLA_FN ElasticEos(double density, double bulk_modulus, double const*) : rho0_(density), kappa_(bulk_modulus) {}
  /// Pressure, positive in compression [Pa]. rho: density [kg/m^3], e: specific energy [J/kg].
  template <class V = double>
  PIOLA_FN V pressure(std::type_identity_t<V> const& rho, std::type_identity_t<V> const&) const {
    return kappa_ * (rho / rho0_ - 1.0);
  }
  /// dp/drho + (p/rho^2) dp/de, the square of the isentropic sound speed [m^2/s^2].
  template <class V = double>
  PIOLA_FN V sound_speed_squared(std::type_identity_t<V> const&, std::type_identity_t<V> const&) const {
    return V(kappa_ / rho0_);
  }
  /// Bulk modulus at rest [Pa].
  PIOLA_FN double bulk_modulus() const { return kappa_; }

 private:
  double rho0_, kappa_;
};

}  // namespace piola::inline PIOLA_BACKEND
