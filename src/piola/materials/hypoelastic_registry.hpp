// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/eos/elastic.hpp"
#include "piola/materials/eos/jwl.hpp"
#include "piola/materials/eos/mie_grueneisen.hpp"
#include "piola/materials/eos/polynomial.hpp"
#include "piola/materials/eos/stiffened_gas.hpp"
#include "piola/materials/hypoelastic_solid.hpp"
#include "piola/materials/laws.hpp"
#include "piola/materials/plastic/isotropic_hardening.hpp"
#include "piola/materials/plastic/johnson_cook.hpp"
#include "piola/materials/plastic/johnson_holmquist.hpp"
#include "piola/materials/plastic/none.hpp"
#include "piola/materials/plastic/perfect.hpp"
#include "piola/materials/plastic/steinberg_guinan.hpp"
#include "piola/materials/plastic/zerilli_armstrong.hpp"
#include <array>

namespace piola::inline PIOLA_BACKEND {

template <class... Eos>
struct EosList {
  static constexpr std::size_t size = sizeof...(Eos);
};

/// The equations of state available with a strength, in the order of `words`. Metals: those of solids.
template <class Strength>
struct EquationsFor {
  using List = EosList<ElasticEos, StiffenedGas, MieGrueneisen, PolynomialEos>;
  static constexpr std::span<std::string_view const> words{eos_words.data(), List::size};
  static constexpr std::span<std::string_view const> damage{damage_words};
};
/// Equations of state for strengths that may vanish (no or perfect plasticity): includes JWL, so the material may be an
/// explosive.
struct EquationsOfFluids {
  using List = EosList<ElasticEos, StiffenedGas, MieGrueneisen, PolynomialEos, JwlEos>;
  static constexpr std::span<std::string_view const> words{eos_words};
  static constexpr std::span<std::string_view const> damage{damage_words};
};
template <>
struct EquationsFor<NoPlasticity> : EquationsOfFluids {};
template <>
struct EquationsFor<PerfectPlasticity> : EquationsOfFluids {};
/// The second model of Johnson and Holmquist combines a strength, a polynomial and a damage.
template <>
struct EquationsFor<JohnsonHolmquist> {
  using List = EosList<PolynomialEos>;
  static constexpr std::span<std::string_view const> words{eos_words.data() + 3, 1};
  static constexpr std::array<std::string_view, 1> own{JohnsonHolmquist::name};
  static constexpr std::span<std::string_view const> damage{own};
};

/// A law of a solid in the registry: a strength with its equations of state.
template <class Strength>
struct SolidLaw {
  static constexpr std::array<Choice, 3> all_choices{
      Choice{"eos", "equation of state: pressure by density and energy", EquationsFor<Strength>::words},
      Choice{"damage", "growth of damage with plastic strain", EquationsFor<Strength>::damage},
      Choice{"spall",
             "what follows from tension at spall_pressure; limit: the pressure goes no lower, nothing opens; "
             "hydrostatic: the material fails there (damage 1); principal: it fails where the largest principal stress "
             "reaches spall_pressure",
             spall_words}};
  /// A solid that does not yield has no damage: it cannot fail.
  static constexpr std::span<Choice const> choices{all_choices.data(), Strength::yields ? 3u : 1u};

 private:
  static constexpr auto joined_parameters() {
    std::array<Parameter, static_cast<std::size_t>(SolidLayout<Strength>::size)> all{};
    std::size_t n = 0;
    auto const append = [&](auto const& some) {
      for (Parameter const& parameter : some) all[n++] = parameter;
    };
    append(ElasticConstants::parameters);
    append(Strength::parameters);
    if (Strength::yields) append(Heat::parameters_for(Strength::homologous));
    append(EosValues::parameters);
    if (Strength::yields) append(JohnsonCookDamage::parameters);
    append(std::array{Parameter{"spall_pressure", "Pa", "spall strength: largest tension the material carries",
                                positive, unbounded, "no limit"}});
    if (Strength::yields) append(Scatter::parameters);
    return all;
  }

 public:
  static constexpr auto parameters = joined_parameters();
};

/// The solids in rate form; in the registry they follow the hyperelastic laws.
template <class... Strength>
struct StrengthList {
  static constexpr int size = sizeof...(Strength);
};
using Strengths = StrengthList<NoPlasticity, PerfectPlasticity, IsotropicHardening, JohnsonCook, ZerilliArmstrong,
                               JohnsonHolmquist, SteinbergGuinan>;

/// Whether the material is a solid in rate form.
inline bool is_hypoelastic(MaterialParameters const& material) {
  return material.law >= Laws::size && material.law < Laws::size + Strengths::size;
}

template <class Strength, class F, class... Eos>
void with_eos(MaterialParameters const& material, F const& f, EosList<Eos...>) {
  int index = 0;
  int const wanted = material.word[SolidLayout<Strength>::eos_word];
  (void)((index++ == wanted ? (f(Solid<Strength, Eos>(material)), true) : false) || ...);
}
template <class F, class... Strength>
void with_solid(MaterialParameters const& material, F const& f, StrengthList<Strength...>) {
  int index = Laws::size;
  (void)((index++ == material.law ? (with_eos<Strength>(material, f, typename EquationsFor<Strength>::List{}), true)
                                  : false) ||
         ...);
}

/// Calls f(solid) with the solid in rate form of `material`, one of two dozen types; does nothing for other laws.
template <class F>
void with_solid(MaterialParameters const& material, F const& f) {
  with_solid(material, f, Strengths{});
}

/// Whether the material is an explosive.
inline bool is_explosive(MaterialParameters const& material) {
  double front = 0;
  with_solid(material, [&](auto const& law) { front = law.front_speed(); });
  return front > 0;
}

/// Calls f(law) with the law of `material`, hyperelastic or a solid in rate form: for their common members.
template <class F>
void with_any_law(MaterialParameters const& material, F const& f) {
  with_law(material, f);
  with_solid(material, f);
}

}  // namespace piola::inline PIOLA_BACKEND
