// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/plastic/adiabatic_heating.hpp"
#include "piola/math/lanes.hpp"
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Linear isotropic hardening: yield stress sy0 + Ep ep, with the plastic modulus Ep = d sy / d ep.
class TrialStrength {
 public:
  static constexpr std::string_view name = "trial_strength";
  static constexpr std::string_view about = "elastic solid in rate form whose yield stress grows with plastic strain";
  static constexpr bool yields = true, thermal = false, homologous = false, brittle = false, pressed = false;
  static constexpr std::array parameters{
      Parameter{"yield_stress", "Pa", "von Mises stress at first yield", positive},
      Parameter{"hardening_modulus", "Pa", "d (yield stress) / d (plastic strain)", not_negative}};

  PIOLA_FN TrialStrength(double const* values, Heat const&) : yield_(values[0]), modulus_(values[1]) {}
  /// Yield stress of a state at a plastic strain rate [1/s] [Pa].
  PIOLA_FN double yield_stress(FlowState const& s, double) const { return yield_ + modulus_ * s.plastic_strain; }
  /// Plastic strain of a step whose trial stress has the von Mises stress `mises` [Pa].
  PIOLA_FN double increment(double mises, double three_mu, FlowState const& s, double, double = 0) const {
    double const yield = yield_stress(s, 0);
    return mises > yield ? (mises - yield) / (three_mu + modulus_) : 0;
  }

  /// As increment(), for several points.
  template <class V>
  PIOLA_FN V increments(V const& mises, double three_mu, V const& plastic_strain) const {
    V const yield = yield_ + modulus_ * plastic_strain;
    return select(mises > yield, (mises - yield) / (three_mu + modulus_), V(0.0));
  }

 private:
  double yield_, modulus_;
};

}  // namespace piola::inline PIOLA_BACKEND
