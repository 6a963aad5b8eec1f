// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <string_view>

namespace piola {

/// The laws of total-Lagrangian formulations: hyperelastic laws and solids in rate form without failure.
inline constexpr std::array<std::string_view, 11> total_lagrangian_laws{
    "linear_elastic",  "neo_hookean",       "mooney_rivlin",       "saint_venant_kirchhoff", "compressible_neo_hookean",
    "elastic",         "perfectly_plastic", "isotropic_hardening", "johnson_cook",           "zerilli_armstrong",
    "steinberg_guinan"};

}  // namespace piola
