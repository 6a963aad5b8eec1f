// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <utility>

/// Solids in rate form: combinations of strength and equation of state as types of a typed test, and sample parameters.
namespace piola::inline PIOLA_BACKEND {

template <class Strength, class Eos>
struct SolidCase {
  using strength = Strength;
  using eos = Eos;
};

template <class... List>
struct Joined;
template <class... A>
struct Joined<::testing::Types<A...>> {
  using type = ::testing::Types<A...>;
};
template <class... A, class... B, class... Rest>
struct Joined<::testing::Types<A...>, ::testing::Types<B...>, Rest...> : Joined<::testing::Types<A..., B...>, Rest...> {
};

template <class Strength, class Eos>
struct OneCase {
  using type = ::testing::Types<SolidCase<Strength, Eos>>;
};
template <class Strength>
struct OneCase<Strength, JwlEos> {  // detonation products are not in equilibrium at rest
  using type = ::testing::Types<>;
};
template <class Strength, class... Eos>
auto cases_of(EosList<Eos...>) -> typename Joined<typename OneCase<Strength, Eos>::type...>::type;

template <class List>
struct SolidCases;
template <class... Strength>
struct SolidCases<StrengthList<Strength...>> {
  using type = typename Joined<decltype(cases_of<Strength>(typename EquationsFor<Strength>::List{}))...>::type;
};

/// Parameters of a law by name. Parameters that are not given have their default, or zero.
inline MaterialParameters parameters_by_name(std::string_view law_name, std::string_view eos, std::string_view damage,
                                             std::initializer_list<std::pair<std::string_view, double>> given) {
  LawInfo const law = *find_law(law_name);
  MaterialParameters material;
  material.law = law.index;
  if (!law.choices.empty()) material.word[0] = index_of(law.choices[0], eos);
  // A law with a built-in damage model has no other choice of damage.
  if (law.choices.size() > 1) material.word[1] = std::max(0, index_of(law.choices[1], damage));
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    Parameter const& p = law.parameters[i];
    material.value[i] = p.required() ? 0 : p.default_value;
    for (auto const& [name, value] : given)
      if (name == p.name) material.value[i] = value;
  }
  return material;
}

/// The aluminium plate of section 3.3 of the AdapTLE paper, for any law and equation of state. Parameters that the
/// paper lacks have values of other materials.
inline MaterialParameters sample_metal(std::string_view law, std::string_view eos, std::string_view damage = "none",
                                       double spall = unbounded) {
  return parameters_by_name(law, eos, damage,
                            {{"density", 2870},
                             {"youngs_modulus", 70e9},
                             {"poissons_ratio", 0.33},
                             {"yield_stress", 479e6},
                             {"hardening_modulus", 2e9},
                             {"hardening_coefficient", 323e6},
                             {"hardening_exponent", .41},
                             {"rate_coefficient", 0.101},
                             {"thermal_exponent", 1.8},
                             {"specific_heat", 875},
                             {"heat_fraction", 0.9},
                             {"reference_temperature", 300},
                             {"melting_temperature", 850},
                             {"bulk_sound_speed", 5328},
                             {"adiabatic_exponent", 2},
                             {"grueneisen_gamma", 2},
                             {"grueneisen_slope", 0.48},
                             {"hugoniot_s1", 1.338},
                             {"c1", 79e9},
                             {"c2", 1e11},
                             {"c3", 5e10},
                             {"c4", 1.5},
                             {"c5", 0.7},
                             {"c6", 0.3},
                             {"d1", 0.45},
                             {"d4", 0.0138},
                             {"athermal_stress", 4.5e8},
                             {"thermal_stress", 4e8},
                             {"thermal_hardening", 8.9e8},
                             {"thermal_softening", 0.0028},
                             {"thermal_rate", 0.000115},
                             {"strain_factor", 10},
                             {"pressure_coefficient", 6.5e-11},
                             {"temperature_coefficient", 6e-4},
                             {"melting_at_rest", 850},
                             {"melting_slope", 1.5},
                             {"melting_gamma", 2},
                             {"hugoniot_elastic_limit", 5.95e9},
                             {"pressure_at_limit", 2.92e9},
                             {"tensile_strength", law == "johnson_holmquist" ? 8.5e9 : unbounded},
                             {"intact_strength", 0.93},
                             {"intact_exponent", 0.77},
                             {"fractured_strength", 0.088},
                             {"fractured_exponent", 0.35},
                             {"fracture_coefficient", 0.053},
                             {"fracture_exponent", 0.85},
                             {"spall_pressure", spall}});
}

/// A stress deviator with the von Mises stress `mises` and all six components non-zero.
inline SymMat<3> deviator_of(double mises) {
  SymMat<3> S{{0.7, -0.2, -0.5, 0.3, -0.4, 0.6}};
  double const scale = mises / von_mises(S);
  for (double& s : S.c) s *= scale;
  return S;
}

}  // namespace piola::inline PIOLA_BACKEND
