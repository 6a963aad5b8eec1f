// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/base/parameter.hpp"
#include "piola/math/lanes.hpp"
#include <array>
#include <string_view>
#include <type_traits>

namespace piola::inline PIOLA_BACKEND {

/// Polynomial in m = rho/rho0 - 1, linear in the energy per reference volume E = rho0 e (LS-DYNA keyword manual,
/// EOS_LINEAR_POLYNOMIAL, with C0 = 0 so that the solid is free of stress at rest):
///   m > 0:  p = C1 m + C2 m^2 + C3 m^3 + (C4 + C5 m + C6 m^2) E
///   m <= 0: p = C1 m + (C4 + C5 m) E
/// LS-DYNA drops C2 and C6 in tension; here C3 too, so that tension is linear as in Mie-Grueneisen.
class PolynomialEos {
 public:
  static constexpr std::string_view name = "polynomial";
  static constexpr std::array parameters{
      Parameter{"c1", "Pa", "C1 of the polynomial, the bulk modulus", positive, 0, "K of E and nu"},
      Parameter{"c2", "Pa", "C2 of the polynomial", any_value, 0},
      Parameter{"c3", "Pa", "C3 of the polynomial", any_value, 0},
      Parameter{"c4", "1", "C4 of the polynomial, times the energy", any_value, 0},
      Parameter{"c5", "1", "C5 of the polynomial, times the energy", any_value, 0},
      Parameter{"c6", "1", "C6 of the polynomial, times the energy", any_value, 0}};

  PIOLA_FN PolynomialEos(double density, double bulk_modulus, double const* v)
      : rho0_(density), c1_(v[0] > 0 ? v[0] : bulk_modulus), c2_(v[1]), c3_(v[2]), c4_(v[3]), c5_(v[4]), c6_(v[5]) {}
  /// Pressure, positive in compression [Pa]. rho: density [kg/m^3], e: specific energy [J/kg].
  template <class V = double>
  PIOLA_FN V pressure(std::type_identity_t<V> const& rho, std::type_identity_t<V> const& e) const {
    V const m = rho / rho0_ - 1.0, pressed = select(m > 0.0, m, V(0.0));
    return c1_ * m + (c2_ + c3_ * pressed) * pressed * pressed + by_energy(m) * (rho0_ * e);
  }
  /// dp/drho + (p/rho^2) dp/de, the square of the isentropic sound speed [m^2/s^2].
  template <class V = double>
  PIOLA_FN V sound_speed_squared(std::type_identity_t<V> const& rho, std::type_identity_t<V> const& e) const {
    V const m = rho / rho0_ - 1.0, pressed = select(m > 0.0, m, V(0.0));
    V const slope = c1_ + (2 * c2_ + 3 * c3_ * pressed) * pressed + (c5_ + 2 * c6_ * pressed) * (rho0_ * e);
    return slope / rho0_ + pressure<V>(rho, e) / (rho * rho) * rho0_ * by_energy(m);
  }
  /// Bulk modulus at rest [Pa].
  PIOLA_FN double bulk_modulus() const { return c1_; }

 private:
  template <class V>
  PIOLA_FN V by_energy(V const& m) const {
    return c4_ + c5_ * m + select(m > 0.0, c6_ * m * m, V(0.0));
  }

  double rho0_, c1_, c2_, c3_, c4_, c5_, c6_;
};

}  // namespace piola::inline PIOLA_BACKEND
