// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/plastic/adiabatic_heating.hpp"
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// The word `damage` of a solid.
inline constexpr std::array<std::string_view, 2> damage_words{"none", "johnson_cook"};

/// Fracture strain of Johnson and Cook (Eng. Fract. Mech. 21, 1985, pp. 31-48):
///   ef = (D1 + D2 exp(D3 s*)) (1 + D4 ln max(rate/rate0, 1)) (1 + D5 T*),  s* = mean stress / von Mises stress,
/// tension positive. Damage grows by (plastic strain of the step) / ef and is complete at 1.
class JohnsonCookDamage {
 public:
  static constexpr Condition with_damage{"damage", "johnson_cook"};
  static constexpr std::array parameters{
      Parameter{"d1", "1", "D1 of the fracture strain", any_value, no_default, {}, with_damage},
      Parameter{"d2", "1", "D2 of the fracture strain", any_value, 0, {}, with_damage},
      Parameter{"d3", "1", "D3, times mean stress over von Mises stress", any_value, 0, {}, with_damage},
      Parameter{"d4", "1", "D4 of the rate term", any_value, 0, {}, with_damage},
      Parameter{"d5", "1", "D5 of the temperature term", any_value, 0, {}, with_damage}};

  /// v: values in the order of `parameters`.
  PIOLA_FN JohnsonCookDamage(double const* v, Heat const& heat)
      : d1_(v[0]), d2_(v[1]), d3_(v[2]), d4_(v[3]), d5_(v[4]), heat_(heat) {}

  /// Fracture strain at a triaxiality (tension positive), a plastic strain rate [1/s] and a temperature [K].
  PIOLA_FN double fracture_strain(double triaxiality, double rate, double temperature) const {
    double exponent = d3_ * triaxiality;
    exponent = exponent > 500 ? 500 : exponent < -500 ? -500 : exponent;  // exp stays finite
    return (d1_ + d2_ * std::exp(exponent)) * (1 + d4_ * heat_.log_rate(rate)) *
           (1 + d5_ * heat_.homologous(temperature));
  }
  /// Damage after a plastic strain increment: at most 1; a fracture strain that is not positive breaks at once.
  PIOLA_FN static double grown(double damage, double increment, double fracture) {
    if (!(increment > 0)) return damage;
    double const after = fracture > 0 ? damage + increment / fracture : 1;
    return after < 1 ? after : 1;
  }

 private:
  double d1_, d2_, d3_, d4_, d5_;
  Heat heat_;
};

}  // namespace piola::inline PIOLA_BACKEND
