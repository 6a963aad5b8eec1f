// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/plastic/adiabatic_heating.hpp"
#include "piola/math/lanes.hpp"
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Perfect plasticity of von Mises: the yield stress is a constant.
class PerfectPlasticity {
 public:
  static constexpr std::string_view name = "perfectly_plastic";
  static constexpr std::string_view about = "elastic solid in rate form with a constant yield stress (von Mises)";
  static constexpr bool yields = true, thermal = false, homologous = false, brittle = false, pressed = false;
  static constexpr bool may_vanish = true;  ///< goes with explosives, too
  static constexpr std::array parameters{Parameter{"yield_stress", "Pa", "von Mises stress at yield", positive}};

  PIOLA_FN PerfectPlasticity(double const* values, Heat const&) : yield_(values[0]) {}
  /// Yield stress of a state at a plastic strain rate [1/s] [Pa].
  PIOLA_FN double yield_stress(FlowState const&, double) const { return yield_; }
  /// Plastic strain of a step whose trial stress has the von Mises stress `mises` [Pa].
  PIOLA_FN double increment(double mises, double three_mu, FlowState const&, double, double = 0) const {
    return mises > yield_ ? (mises - yield_) / three_mu : 0;
  }

  /// Whether increments() has the plastic strain in closed form.
  PIOLA_FN static bool closed_form() { return true; }
  /// As increment(), for several points.
  template <class V>
  PIOLA_FN V increments(V const& mises, double three_mu, V const&) const {
    return select(mises > yield_, (mises - yield_) / three_mu, V(0.0));
  }

 private:
  double yield_;
};

}  // namespace piola::inline PIOLA_BACKEND
