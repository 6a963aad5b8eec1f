// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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

using NamedValue = std::pair<std::string_view, double>;
using NamedValues = std::vector<NamedValue>;

/// Sets those parameters of the material's law that have one of these names.
inline void set_parameters(MaterialParameters& material, std::span<NamedValue const> given) {
  std::span<Parameter const> const parameters = law_of(material).parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    for (auto const& [name, value] : given)
      if (name == parameters[i].name) material.value[i] = value;
}

/// Parameters of a law by name. Parameters that are not given have their default, or zero; a table is that of some
/// aluminium.
inline MaterialParameters parameters_by_name(std::string_view law_name, std::string_view eos, std::string_view damage,
                                             std::initializer_list<NamedValue> given) {
  LawInfo const law = *find_law(law_name);
  MaterialParameters material;
  material.law = law.index;
  if (!law.choices.empty()) material.word[0] = index_of(law.choices[0], eos);
  // A law with a built-in damage model has no other choice of damage.
  if (law.choices.size() > 1) material.word[1] = std::max(0, index_of(law.choices[1], damage));
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    Parameter const& p = law.parameters[i];
    material.value[i] = p.required() ? 0 : p.default_value;
  }
  set_parameters(material, std::span(given.begin(), given.size()));
  if (law.table != nullptr) material.table = {4, {0, 0.02, 0.1, 0.5}, {479e6, 550e6, 640e6, 700e6}};
  return material;
}

/// Aluminium of Melosh 1989, and hardening that depends on the rate.
inline constexpr NamedValue more_samples[]{
    {"voce_q", 2e8},       {"voce_b", 12},         {"cowper_symonds_c", 6500},   {"cowper_symonds_p", 4},
    {"tillotson_a", 0.5},  {"tillotson_b", 1.63},  {"tillotson_bulk_a", 75.2e9}, {"tillotson_bulk_b", 65e9},
    {"tillotson_e0", 5e6}, {"tillotson_eiv", 3e6}, {"tillotson_ecv", 13.9e6},    {"tillotson_alpha", 5},
    {"tillotson_beta", 5}};

/// The aluminium plate of section 3.3 of the AdapTLE paper, for any law and equation of state. Parameters that the
/// paper lacks have values of other materials.
inline MaterialParameters sample_metal(std::string_view law, std::string_view eos, std::string_view damage = "none",
                                       double spall = unbounded) {
  MaterialParameters metal = parameters_by_name(law, eos, damage,
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
  set_parameters(metal, more_samples);
  if (law == IsotropicHardening::name) set_parameters(metal, NamedValues{{"cowper_symonds_c", 0}});
  return metal;
}

/// A stress deviator with the von Mises stress `mises` and all six components non-zero.
inline SymMat<3> deviator_of(double mises) {
  SymMat<3> S{{0.7, -0.2, -0.5, 0.3, -0.4, 0.6}};
  double const scale = mises / von_mises(S);
  for (double& s : S.c) s *= scale;
  return S;
}

}  // namespace piola::inline PIOLA_BACKEND
