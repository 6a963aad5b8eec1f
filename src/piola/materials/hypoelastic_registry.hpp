// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/block_law.hpp"
#include "piola/materials/hypoelastic_solid.hpp"
#include "piola/materials/laws.hpp"
#include "piola/materials/plastic/isotropic_hardening.hpp"
#include "piola/materials/plastic/johnson_cook.hpp"
#include "piola/materials/plastic/johnson_holmquist.hpp"
#include "piola/materials/plastic/none.hpp"
#include "piola/materials/plastic/perfect.hpp"
#include "piola/materials/plastic/steinberg_guinan.hpp"
#include "piola/materials/plastic/tabulated_hardening.hpp"
#include "piola/materials/plastic/voce.hpp"
#include "piola/materials/plastic/zerilli_armstrong.hpp"
#include <array>

namespace piola::inline PIOLA_BACKEND {

/// The equations of state and the words of `damage` available with a strength. A strength that is brittle brings its
/// own damage.
template <class Strength>
struct EquationsFor {
  using List = decltype(equations_with<Strength>(EquationsOfState{}));
  static constexpr std::array own_damage{Strength::name};
  static constexpr std::span<std::string_view const> damage{Strength::brittle ? own_damage.data() : damage_words.data(),
                                                            Strength::brittle ? 1 : damage_words.size()};
};

/// A law of a solid in the registry: a strength with its equations of state.
template <class Strength>
struct SolidLaw {
  static constexpr std::array<Choice, 4> all_choices{
      Choice{"eos", "equation of state: pressure by density and energy", EquationsFor<Strength>::List::words},
      Choice{"damage", "growth of damage with plastic strain", EquationsFor<Strength>::damage},
      Choice{"spall",
             "what follows from tension at spall_pressure; limit: the pressure goes no lower, nothing opens; "
             "hydrostatic: the material fails there (damage 1); principal: it fails where the largest principal stress "
             "reaches spall_pressure",
             spall_words},
      Choice{
          "rate_dependence",
          "growth of the yield stress with the plastic strain rate; cowper_symonds: by the factor 1 + (rate/C)^(1/p) "
          "(Cowper and Symonds 1957)",
          CowperSymonds::words}};
  static constexpr bool has_rate_dependence = requires { Strength::has_rate_dependence; };
  /// A solid that does not yield has no damage: it cannot fail.
  static constexpr std::span<Choice const> choices{all_choices.data(),
                                                   has_rate_dependence ? 4u : (Strength::yields ? 3u : 1u)};
  /// The table of the strength; null: it has none.
  static constexpr TableParameter const* table = [] {
    if constexpr (requires { Strength::table; }) return &Strength::table;
    return static_cast<TableParameter const*>(nullptr);
  }();

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
    append(eos_parameters);
    if (Strength::yields) append(JohnsonCookDamage::parameters);
    append(std::array{Parameter{"spall_pressure", "Pa", "spall strength: largest tension the material carries",
                                positive, unbounded, "no limit"}});
    if (!Strength::brittle) append(Fracture::parameters);
    append(Scatter::parameters);
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
using Strengths = StrengthList<NoPlasticity, PerfectPlasticity, IsotropicHardening, Voce, TabulatedHardening,
                               JohnsonCook, ZerilliArmstrong, JohnsonHolmquist, SteinbergGuinan>;

/// Whether the material is a solid in rate form.
inline bool is_hypoelastic(MaterialParameters const& material) {
  return material.law >= Laws::size && material.law < Laws::size + Strengths::size;
}

template <class Strength, class F, class... Eos>
void with_eos(MaterialParameters const& material, F const& f, EosList<Eos...>) {
  int index = 0;
  int const wanted = material.word[SolidLayout<Strength>::eos_word];
  using Runs = typename SolidOf<Strength>::Runs;
  (void)((index++ == wanted ? (f(Solid<Runs, Eos>(material, SolidOf<Strength>{})), true) : false) || ...);
}
template <class F, class... Strength>
void with_solid(MaterialParameters const& material, F const& f, StrengthList<Strength...>) {
  int index = Laws::size;
  (void)((index++ == material.law ? (with_eos<Strength>(material, f, typename EquationsFor<Strength>::List{}), true)
                                  : false) ||
         ...);
}

/// Calls f(solid) with the solid in rate form of `material`, one of three dozen types; does nothing for other laws.
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

/// Whether heat raises the pressure of the material at rest, as where its law serves shocks.
inline bool has_thermal_pressure(MaterialParameters const& material) {
  constexpr double heat = 1e4;  // [J/kg]
  bool thermal = false;
  with_solid(material, [&](auto const& law) { thermal = law.pressure(law.rho0, heat) > law.pressure(law.rho0, 0); });
  with_block_law(material, [&](BlockLaw const& law) {
    auto const cold = law.stress_at({}), hot = law.stress_at({}, heat);
    thermal = !law.elastic() && hot[0] + hot[1] + hot[2] < cold[0] + cold[1] + cold[2];
  });
  return thermal;
}

/// Whether points of the material keep their internal energy from step to step; else it is a potential.
inline bool stores_internal_energy(MaterialParameters const& material) {
  bool stores = is_hypoelastic(material);
  with_block_law(material, [&](BlockLaw const& law) { stores = !law.elastic(); });
  return stores;
}

/// Heat of the material; of one without temperature: no heating, no conduction.
inline Heat heat_of(MaterialParameters const& material) {
  Heat heat;
  with_solid(material, [&](auto const& law) { heat = law.heat(); });
  return heat;
}

/// Whether the material fails: by damage, spall or cracks.
inline bool fails(MaterialParameters const& material) {
  bool any = false;
  with_solid(material, [&](auto const& law) { any = law.damages || law.fracture.strength < unbounded; });
  return any;
}

/// Calls f(law) with the law of `material`, hyperelastic, a solid in rate form or on blocks of points: for their common
/// members.
template <class F>
void with_any_law(MaterialParameters const& material, F const& f) {
  with_law(material, f);
  with_solid(material, f);
  with_block_law(material, f);
}

}  // namespace piola::inline PIOLA_BACKEND
