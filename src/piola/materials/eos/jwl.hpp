// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/base/parameter.hpp"
#include "piola/math/lanes.hpp"
#include <array>
#include <cmath>
#include <string_view>
#include <type_traits>

namespace piola::inline PIOLA_BACKEND {

/// Gases of a detonated explosive, by Jones, Wilkins and Lee (E. L. Lee, H. C. Hornig, J. W. Kury, UCRL-50422, 1968).
/// V = rho0/rho, E = rho0 e energy per volume of the explosive, which starts at the energy of detonation:
///   p = A (1 - omega/(R1 V)) exp(-R1 V) + B (1 - omega/(R2 V)) exp(-R2 V) + omega E/V
/// Partly burnt explosive has a fraction of this pressure: see burnt().
class JwlEos {
 public:
  static constexpr std::string_view name = "jwl";
  static constexpr std::array parameters{
      Parameter{"jwl_a", "Pa", "A of the gases of an explosive", positive},
      Parameter{"jwl_b", "Pa", "B of the gases of an explosive", any_value},
      Parameter{"jwl_r1", "1", "R1, times the volume ratio, in the exponent of A", positive},
      Parameter{"jwl_r2", "1", "R2, times the volume ratio, in the exponent of B", positive},
      Parameter{"jwl_omega", "1", "omega, Grueneisen's gamma of the gases", positive},
      Parameter{"detonation_energy", "J/m^3", "E0, energy per volume of the explosive, which its gases start with",
                positive},
      Parameter{"detonation_speed", "m/s", "speed of the detonation front", positive}};

  PIOLA_FN JwlEos(double density, double, double const* v)
      : initial_energy(v[5] / density),
        front_speed(v[6]),
        rho0_(density),
        a_(v[0]),
        b_(v[1]),
        r1_(v[2]),
        r2_(v[3]),
        omega_(v[4]),
        per_compression_(1 / (1 - cj_volume())) {}

  double initial_energy;  ///< [J/kg]
  double front_speed;     ///< of the detonation [m/s]

  /// Burnt fraction of an explosive: the larger of that by the time since its ignition and of that by its compression,
  /// (1 - V)/(1 - V_CJ) up to 1, V_CJ the state of Chapman and Jouguet (LS-DYNA, MAT_HIGH_EXPLOSIVE_BURN, beta = 0;
  /// Wilkins 1964). By time alone, explosive ahead of a front that is lit too slowly has no pressure, and is compressed
  /// without bound.
  template <class V = double>
  PIOLA_FN V burnt(std::type_identity_t<V> const& by_time, std::type_identity_t<V> const& rho) const {
    V const by_volume = (1.0 - rho0_ / rho) * per_compression_;
    return minimum(maximum(by_time, by_volume), V(1.0));
  }
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

  /// One exponential of the density, and its derivative.
  template <class T>
  PIOLA_FN Term<T> term(double factor, double r, T const& rho) const {
    T const V = rho0_ / rho, fall = factor * exponential(-r * V), part = omega_ / (r * V);
    // dV/drho = -V/rho
    return {fall * (1.0 - part), fall * (r * V * (1.0 - part) - part) / rho};
  }

  /// V of Chapman and Jouguet: where the line of Rayleigh touches the Hugoniot, and so is least steep.
  PIOLA_FN double cj_volume() const {
    double const part = 0.5 * (std::sqrt(5.0) - 1);  // golden section, 1e-5 at the end
    double low = 0.5, high = 0.99;
    for (int k = 0; k < 22; ++k) {
      double const left = high - part * (high - low), right = low + part * (high - low);
      if (rayleigh_slope(left) < rayleigh_slope(right))
        high = right;
      else
        low = left;
    }
    return 0.5 * (low + high);
  }
  /// p/(1 - V) of the Hugoniot E = E0 + p (1 - V)/2 [Pa].
  PIOLA_FN double rayleigh_slope(double V) const {
    double const rho = rho0_ / V;
    return pressure(rho, initial_energy) / (1 - omega_ * (1 - V) / (2 * V)) / (1 - V);
  }

  double rho0_, a_, b_, r1_, r2_, omega_, per_compression_;
};

}  // namespace piola::inline PIOLA_BACKEND
