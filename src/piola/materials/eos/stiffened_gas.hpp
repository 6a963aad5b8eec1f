// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/materials/eos/bulk_sound_speed.hpp"
#include "piola/math/lanes.hpp"
#include <array>
#include <string_view>
#include <type_traits>

namespace piola::inline PIOLA_BACKEND {

/// Stiffened gas: p = c0^2 (rho - rho0) + (gamma0 - 1) rho e (Young, Teixeira-Dias, Azevedo, Mill, Int. J. Mech. Sci.
/// 192, 2021, eq. 17).
class StiffenedGas {
 public:
  static constexpr std::string_view name = "stiffened_gas";
  static constexpr std::array parameters{
      bulk_sound_speed_parameter,
      Parameter{"adiabatic_exponent", "1", "gamma0 of the stiffened gas", Interval{1, unbounded, false, true}}};

  PIOLA_FN StiffenedGas(double density, double bulk_modulus, double const* v) : rho0_(density), g_(v[1] - 1) {
    double const c0 = bulk_sound_speed(v[0], density, bulk_modulus);
    c0_squared_ = c0 * c0;
  }
  /// Pressure, positive in compression [Pa]. rho: density [kg/m^3], e: specific energy [J/kg].
  template <class V = double>
  PIOLA_FN V pressure(std::type_identity_t<V> const& rho, std::type_identity_t<V> const& e) const {
    return c0_squared_ * (rho - rho0_) + g_ * rho * e;
  }
  /// dp/drho + (p/rho^2) dp/de, the square of the isentropic sound speed [m^2/s^2].
  template <class V = double>
  PIOLA_FN V sound_speed_squared(std::type_identity_t<V> const& rho, std::type_identity_t<V> const& e) const {
    return c0_squared_ + g_ * e + pressure<V>(rho, e) / rho * g_;
  }
  /// Bulk modulus at rest [Pa].
  PIOLA_FN double bulk_modulus() const { return rho0_ * c0_squared_; }

 private:
  double rho0_, c0_squared_, g_;
};

}  // namespace piola::inline PIOLA_BACKEND
