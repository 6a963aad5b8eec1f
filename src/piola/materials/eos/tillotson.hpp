// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/base/parameter.hpp"
#include "piola/math/lanes.hpp"
#include <array>
#include <string_view>
#include <type_traits>

namespace piola::inline PIOLA_BACKEND {

/// Equation of state of Tillotson for impacts in which the material melts and vaporises (J. H. Tillotson, General
/// Atomic report GA-3216, 1962; H. J. Melosh, Impact Cratering, 1989, appendix II). eta = rho/rho0, m = eta - 1, z =
/// 1/eta - 1, W = e/(E0 eta^2) + 1:
///   compressed, or e <= Eiv:  p = (a + b/W) rho e + A m + B m^2
///   expanded, e >= Ecv:       p = a rho e + (b rho e/W + A m exp(-beta z)) exp(-alpha z^2)
///   expanded, between both:   the first and the second, weighted linearly by the energy.
/// Negative energies, as after tension, have W = 1, so that W has no root; pressure and slope stay continuous.
class Tillotson {
 public:
  static constexpr std::string_view name = "tillotson";
  static constexpr std::array parameters{
      Parameter{"tillotson_a", "1", "a, gamma of hot gas, typically 0.5 (Tillotson 1962; Melosh 1989, appendix II)",
                positive},
      Parameter{"tillotson_b", "1", "b; a + b is Grueneisen's gamma of the cold solid", not_negative},
      Parameter{"tillotson_bulk_a", "Pa", "A, bulk modulus at rest", positive, 0, "K of E and nu"},
      Parameter{"tillotson_bulk_b", "Pa", "B, times the square of the compression", any_value},
      Parameter{"tillotson_e0", "J/kg", "E0, energy at which b has half its effect at rest", positive},
      Parameter{"tillotson_eiv", "J/kg", "Eiv, energy of incipient vaporisation", positive},
      Parameter{"tillotson_ecv", "J/kg", "Ecv, energy of complete vaporisation, above Eiv", positive},
      Parameter{"tillotson_alpha", "1", "alpha, decay of b and of the cold pressure with expansion", positive},
      Parameter{"tillotson_beta", "1", "beta, further decay of the cold pressure", positive}};

  PIOLA_FN Tillotson(double density, double bulk_modulus, double const* v)
      : rho0_(density),
        a_(v[0]),
        b_(v[1]),
        A_(v[2] > 0 ? v[2] : bulk_modulus),
        B_(v[3]),
        e0_(v[4]),
        eiv_(v[5]),
        per_range_(1 / (v[6] - v[5])),
        alpha_(v[7]),
        beta_(v[8]) {}
  /// Pressure, positive in compression [Pa]. rho: density [kg/m^3], e: specific energy [J/kg].
  template <class V = double>
  PIOLA_FN V pressure(std::type_identity_t<V> const& rho, std::type_identity_t<V> const& e) const {
    return state<V>(rho, e).pressure;
  }
  /// dp/drho + (p/rho^2) dp/de, the square of the isentropic sound speed [m^2/s^2].
  template <class V = double>
  PIOLA_FN V sound_speed_squared(std::type_identity_t<V> const& rho, std::type_identity_t<V> const& e) const {
    State<V> const at = state<V>(rho, e);
    return at.by_density + at.pressure / (rho * rho) * at.by_energy;
  }
  /// Bulk modulus at rest [Pa].
  PIOLA_FN double bulk_modulus() const { return A_; }

 private:
  template <class V>
  struct State {
    V pressure, by_density, by_energy;  ///< and its derivatives
  };

  template <class V>
  PIOLA_FN State<V> state(V const& rho, V const& e) const {
    V const eta = rho / rho0_, m = eta - 1.0;
    V const heat = select(e > 0.0, e, V(0.0)) / (e0_ * eta * eta), w = 1.0 / (heat + 1.0);
    // The part b rho e/W.
    State<V> const part{b_ * rho * e * w, b_ * e * w * (1.0 + 2.0 * w * heat), b_ * rho * w * w};
    State<V> const gas{a_ * rho * e, a_ * e, a_ * rho};
    State<V> const solid{gas.pressure + part.pressure + (A_ + B_ * m) * m,
                         gas.by_density + part.by_density + (A_ + 2 * B_ * m) / rho0_, gas.by_energy + part.by_energy};
    V const above = select(m < 0.0, (e - eiv_) * per_range_, V(0.0));
    if (!any(above > 0.0)) return solid;  // most particles
    V const weight = minimum(maximum(above, V(0.0)), V(1.0));
    State<V> const hot = vapour(gas, part, rho, eta);
    V const more = hot.pressure - solid.pressure;
    V const growth = select(above > 0.0, select(above < 1.0, V(per_range_), V(0.0)), V(0.0));
    return {solid.pressure + weight * more, solid.by_density + weight * (hot.by_density - solid.by_density),
            solid.by_energy + weight * (hot.by_energy - solid.by_energy) + growth * more};
  }
  /// The expanded state above the energy of complete vaporisation.
  template <class V>
  PIOLA_FN State<V> vapour(State<V> const& gas, State<V> const& part, V const& rho, V const& eta) const {
    V const m = eta - 1.0, z = 1.0 / eta - 1.0, per_z = -1.0 / (eta * rho);  // dz/drho
    V const thin = exponential(-alpha_ * z * z), cold = A_ * exponential(-beta_ * z);
    V const bound = part.pressure + m * cold;
    V const slope = part.by_density + cold / rho0_ - beta_ * per_z * m * cold;
    return {gas.pressure + bound * thin, gas.by_density + (slope - 2.0 * alpha_ * z * per_z * bound) * thin,
            gas.by_energy + part.by_energy * thin};
  }

  double rho0_, a_, b_, A_, B_, e0_, eiv_, per_range_, alpha_, beta_;
};

}  // namespace piola::inline PIOLA_BACKEND
