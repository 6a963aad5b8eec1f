// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/hypoelastic_registry.hpp"
#include "formulations/small_bodies.hpp"

/// Copper for tests of solids in rate form, and its reference response.
namespace piola::testing::metals {

inline constexpr double rho0 = 8930, E = 117e9, nu = 0.35, yield = 400e6, hardening = 100e6;

inline MaterialParameters copper(std::string_view law = "isotropic_hardening") {
  auto const info = find_law(law).value();
  MaterialParameters m = material(law, rho0, E, nu);
  auto const set = [&](std::string_view name, double value) {
    for (std::size_t i = 0; i < info.parameters.size(); ++i)
      if (info.parameters[i].name == name) m.value[i] = value;
  };
  for (std::size_t i = 3; i < info.parameters.size(); ++i)
    m.value[i] = std::isnan(info.parameters[i].default_value) ? 0 : info.parameters[i].default_value;
  set("yield_stress", yield);
  set("hardening_modulus", hardening);
  set("hardening_coefficient", 292e6);
  set("hardening_exponent", 0.31);
  set("rate_coefficient", 0.025);
  set("melting_temperature", 1356);
  set("specific_heat", 383);
  return m;
}

struct Sheared {
  SymMat<3> S;  ///< deviator [Pa]
  double plastic_strain = 0;
};
/// Reference response of copper in simple shear v_x = rate Y until `end` [s]: the rate equation in 20,000 steps.
inline Sheared simple_shear(double rate, double end) {
  Sheared sheared;
  with_solid(copper(), [&](auto const& law) {
    SolidHistory h;
    int const n = 20000;
    Mat<3> L;
    L(0, 1) = rate;
    for (int k = 0; k < n; ++k) {
      SymMat<3> trial = law.deviator_rate(h.S, L);
      for (int c = 0; c < 6; ++c) trial.c[c] = h.S.c[c] + end / n * trial.c[c];
      law.update(h, trial, 0, rho0, end / n);
    }
    sheared = {h.S, h.plastic_strain};
  });
  return sheared;
}

}  // namespace piola::testing::metals
