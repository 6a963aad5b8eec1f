// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/hyperelastic/compressible_neo_hookean.hpp"
#include "piola/materials/hyperelastic/linear_elastic.hpp"
#include "piola/materials/hyperelastic/mooney_rivlin.hpp"
#include "piola/materials/hyperelastic/neo_hookean.hpp"
#include "piola/materials/hyperelastic/saint_venant_kirchhoff.hpp"
#include "piola/materials/registry.hpp"
#include <concepts>

namespace piola::inline PIOLA_BACKEND {

/// Interface of a law for total-Lagrangian formulations, at one point, in three dimensions. T is double or lanes.
template <class Law> concept Hyperelastic = requires(Law const& law, Mat<3> const& F, double J) {
  { law.first_piola(F) } -> std::same_as<Mat<3>>;
  { law.stress(F, F, J) } -> std::same_as<Mat<3>>;
  { law.energy(F) } -> std::same_as<double>;
  { law.energy(F, F, J) } -> std::same_as<double>;
  { law.pressure(F) } -> std::same_as<double>;
  { law.largest_modulus(J, J, J) } -> std::same_as<double>;
  { law.p_wave_speed() } -> std::same_as<double>;
  { law.rho0 } -> std::convertible_to<double>;
  { law.mu } -> std::convertible_to<double>;
  { law.kappa } -> std::convertible_to<double>;
  { Law::small_strain } -> std::convertible_to<bool>;
  { Law::volumetric_split } -> std::convertible_to<bool>;
};

/// Additional interface of a law whose energy is an isochoric part plus kappa/2 (J - 1)^2, for schemes that evolve a
/// volume ratio or a pressure.
template <class Law> concept SplitsVolume = requires(Law const& law, Mat<3> const& F, double p) {
  { law.stress_with_pressure(F, p) } -> std::same_as<Mat<3>>;
  { law.stress_with_pressure(F, F, p, p) } -> std::same_as<Mat<3>>;
  { law.isochoric_energy(F) } -> std::same_as<double>;
  { law.isochoric_energy(F, F, p) } -> std::same_as<double>;
  { law.volume_ratio(F) } -> std::same_as<double>;
};

/// Interface of a law for formulations that evolve the stress, in rate form.
template <class Law> concept RateForm = requires(Law const& law, SymMat<3> const& d) {
  { law.stress_rate(d) } -> std::same_as<SymMat<3>>;
  { law.energy_of_stress(d) } -> std::same_as<double>;
  { law.rho0 } -> std::convertible_to<double>;
  { law.lambda } -> std::convertible_to<double>;
  { law.mu } -> std::convertible_to<double>;
};

template <class... Law>
struct LawList {
  static_assert((Hyperelastic<Law> && ...), "a registered law lacks a member of the concept Hyperelastic");
  static_assert(((!Law::volumetric_split || SplitsVolume<Law>)&&...),
                "a law with a split lacks a member of the concept SplitsVolume");
  static constexpr int size = sizeof...(Law);
};

/// The registered laws. Adding one: its header and one name here; its battery of tests is automatic.
using Laws = LawList<LinearElastic, NeoHookean, MooneyRivlin, SaintVenantKirchhoff, CompressibleNeoHookean>;

template <class F, class... Law>
void with_law(MaterialParameters const& material, F const& f, LawList<Law...>) {
  int index = 0;
  (void)((index++ == material.law ? (f(Law(material.value)), true) : false) || ...);
}

/// Calls f(law) with the law of `material`: the one dynamic decision per group and step.
template <class F>
void with_law(MaterialParameters const& material, F const& f) {
  with_law(material, f, Laws{});
}

}  // namespace piola::inline PIOLA_BACKEND
