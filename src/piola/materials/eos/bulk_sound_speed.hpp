// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/base/parameter.hpp"
#include <cmath>

namespace piola::inline PIOLA_BACKEND {

/// c0, parameter of several equations of state.
inline constexpr Parameter bulk_sound_speed_parameter{
    "bulk_sound_speed", "m/s", "c0, sound speed of the pressure alone at rest", positive, 0, "sqrt(K/density)"};

/// c0 [m/s]: the value given [m/s], or for 0 that of the density [kg/m^3] and the bulk modulus [Pa].
PIOLA_FN double bulk_sound_speed(double given, double density, double bulk_modulus) {
  return given > 0 ? given : std::sqrt(bulk_modulus / density);
}

}  // namespace piola::inline PIOLA_BACKEND
