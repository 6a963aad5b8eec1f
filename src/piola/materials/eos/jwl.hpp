// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/materials/eos/values.hpp"
#include "piola/math/lanes.hpp"
#include <cmath>
#include <type_traits>

namespace piola::inline PIOLA_BACKEND {

/// Gases of a detonated explosive, by Jones, Wilkins and Lee (E. L. Lee, H. C. Hornig, J. W. Kury, UCRL-50422, 1968).
/// V = rho0/rho, E = rho0 e energy per volume of the explosive, which starts at the energy of detonation:
///   p = A (1 - omega/(R1 V)) exp(-R1 V) + B (1 - omega/(R2 V)) exp(-R2 V) + omega E/V
/// Partly burnt explosive has a fraction of this pressure (SolidHistory::burnt).
class JwlEos {
 public:
  PIOLA_FN explicit JwlEos(EosValues const& values)
      : initial_energy(values.detonation / values.rho0),
        front_speed(values.front),
        rho0_(values.rho0),
        a_(values.a),
        b_(values.b),
        r1_(values.r1),
        r2_(values.r2),
        omega_(values.omega) {}

  double initial_energy;  ///< [J/kg]
  double front_speed;     ///< of the detonation [m/s]

  /// Pressure of the gases, positive in compression [Pa]. rho: density [kg/m^3], e: specific energy [J/kg].
  template <class V = double>
  PIOLA_FN V pressure(std::type_identity_t<V> const& rho, std::type_identity_t<V> const& e) const {
    return term<V>(a_, r1_, rho).value + term<V>(b_, r2_, rho).value + omega_ * rho * e;
  }
  /// dp/drho + (p/rho^2) dp/de, the square of the isentropic sound speed [m^2/s^2].
  template <class V = double>
  PIOLA_FN V sound_speed_squared(std::type_identity_t<V> const& rho, std::type_identity_t<V> const& e) const {
    return term<V>(a_, r1_, rho).slope + term<V>(b_, r2_, rho).slope + omega_ * e + pressure<V>(rho, e) / rho * omega_;
  }
  /// Bulk modulus of the gases in the volume of the explosive [Pa].
  PIOLA_FN double bulk_modulus() const { return rho0_ * sound_speed_squared(rho0_, initial_energy); }

 private:
  template <class V>
  struct Term {
    V value, slope;
  };

  template <class T>
  PIOLA_FN static T exponential(T const& a) {
    double r[width<T>];
    for (int l = 0; l < width<T>; ++l) r[l] = std::exp(lane(a, l));
    return load<T>(r);
  }

  /// One exponential of the density, and its derivative.
  template <class T>
  PIOLA_FN Term<T> term(double factor, double r, T const& rho) const {
    T const V = rho0_ / rho, fall = factor * exponential(-r * V), part = omega_ / (r * V);
    // dV/drho = -V/rho
    return {fall * (1.0 - part), fall * (r * V * (1.0 - part) - part) / rho};
  }

  double rho0_, a_, b_, r1_, r2_, omega_;
};

}  // namespace piola::inline PIOLA_BACKEND
