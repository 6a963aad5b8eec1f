// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/plastic/adiabatic_heating.hpp"
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// A solid that never yields.
struct NoPlasticity {
  static constexpr std::string_view name = "elastic";
  static constexpr std::string_view about = "elastic solid in rate form (Jaumann), with an equation of state";
  static constexpr bool yields = false, thermal = false, homologous = false, brittle = false, pressed = false;
  static constexpr bool may_vanish = true;  ///< goes with explosives, too
  static constexpr std::array<Parameter, 0> parameters{};

  PIOLA_FN NoPlasticity(double const*, Heat const&) {}
  /// Yield stress of a state at a plastic strain rate [1/s] [Pa].
  PIOLA_FN static double yield_stress(FlowState const&, double) { return unbounded; }
  /// Plastic strain of a step whose trial stress has the von Mises stress `mises` [Pa].
  PIOLA_FN static double increment(double, double, FlowState const&, double, double = 0) { return 0; }
};

}  // namespace piola::inline PIOLA_BACKEND
