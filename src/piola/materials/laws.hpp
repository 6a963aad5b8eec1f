// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/hyperelastic/linear_elastic.hpp"
#include "piola/materials/hyperelastic/neo_hookean.hpp"
#include "piola/materials/registry.hpp"
#include <concepts>

namespace piola::inline PIOLA_MACHINE {

/// What a total-Lagrangian formulation asks of a law, at one point, in three dimensions. T is double or lanes.
template <class Law> concept Hyperelastic = requires(Law const& law, Mat<3> const& F, double p) {
  { law.stress_with_pressure(F, p) } -> std::same_as<Mat<3>>;
  { law.isochoric_energy(F) } -> std::same_as<double>;
  { law.volume_ratio(F) } -> std::same_as<double>;
  { law.first_piola(F) } -> std::same_as<Mat<3>>;
  { law.energy(F) } -> std::same_as<double>;
  { law.pressure(F) } -> std::same_as<double>;
  { law.p_wave_speed() } -> std::same_as<double>;
  { law.rho0 } -> std::convertible_to<double>;
};

template <class... Law>
struct LawList {
  static_assert((Hyperelastic<Law> && ...), "a registered law lacks one of the questions of the concept");
  static constexpr int size = sizeof...(Law);
};

/// The registered laws. Adding one: its header and one name here; its battery of tests is automatic.
using Laws = LawList<LinearElastic, NeoHookean>;

template <class F, class... Law>
void with_law(MaterialParameters const& material, F const& f, LawList<Law...>) {
  int index = 0;
  (void)((index++ == material.law ? (f(Law(material.value)), true) : false) || ...);
}

/// Calls f(law) with the law that `material` names: the one dynamic decision per group and step.
template <class F>
void with_law(MaterialParameters const& material, F const& f) {
  with_law(material, f, Laws{});
}

}  // namespace piola::inline PIOLA_MACHINE
