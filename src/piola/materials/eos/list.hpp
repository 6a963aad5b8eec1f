// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/eos/elastic.hpp"
#include "piola/materials/eos/jwl.hpp"
#include "piola/materials/eos/mie_grueneisen.hpp"
#include "piola/materials/eos/polynomial.hpp"
#include "piola/materials/eos/stiffened_gas.hpp"
#include "piola/materials/eos/tillotson.hpp"
#include <algorithm>
#include <array>
#include <string_view>
#include <type_traits>
#include <utility>

namespace piola::inline PIOLA_BACKEND {

template <class... Eos>
struct EosList {
  static constexpr std::size_t size = sizeof...(Eos);
  static constexpr std::array<std::string_view, size> words{Eos::name...};  ///< of the choice `eos`
};

/// All equations of state, in the order of their numbers in MaterialParameters::word and of their parameters. Adding
/// one: its header and one name here.
using EquationsOfState = EosList<ElasticEos, StiffenedGas, MieGrueneisen, PolynomialEos, JwlEos, Tillotson>;

/// Whether the equation of state is that of an explosive, which a front burns.
template <class Eos> concept Explosive = requires(Eos const& eos) { eos.front_speed; };

/// Whether the strength goes with the equation of state: with that of its model alone, if it names one; explosives go
/// with strengths that may vanish.
template <class Strength, class Eos>
constexpr bool goes_with() {
  if constexpr (requires { typename Strength::Eos; }) return std::is_same_v<Eos, typename Strength::Eos>;
  return !Explosive<Eos> || requires { Strength::may_vanish; };
}

template <class... A, class... B>
EosList<A..., B...> operator+(EosList<A...>, EosList<B...>);
/// The equations of state of a list that go with a strength.
template <class Strength, class... Eos>
auto equations_with(EosList<Eos...>)
    -> decltype((EosList<>{} + ... + std::conditional_t<goes_with<Strength, Eos>(), EosList<Eos>, EosList<>>{}));

/// Parameters of the equations of state in the order of their first use, each with its words, and their number.
template <class... Eos>
constexpr auto join_parameters(EosList<Eos...>) {
  std::pair<std::array<Parameter, (Eos::parameters.size() + ...)>, std::size_t> joint{};
  auto& all = joint.first;
  std::size_t& n = joint.second;
  auto const add = [&](std::string_view eos, auto const& parameters) {
    for (Parameter const& parameter : parameters) {
      std::size_t i = 0;
      while (i < n && all[i].name != parameter.name) ++i;
      if (i == n) {
        all[n++] = parameter;
        all[i].when = Condition{"eos", eos};
      } else {
        if (!all[i].when.other.empty()) throw "a condition has two words";
        all[i].when.other = eos;
      }
    }
  };
  (add(Eos::name, Eos::parameters), ...);
  return joint;
}

/// Parameters of all equations of state. A solid reads them all; its equation of state takes its own.
inline constexpr auto eos_parameters = [] {
  constexpr auto joint = join_parameters(EquationsOfState{});
  std::array<Parameter, joint.second> all{};
  std::copy_n(joint.first.begin(), all.size(), all.begin());
  return all;
}();

/// Places of the parameters of an equation of state among `eos_parameters`. Loops over parameters compare by != because
/// nvcc warns of k < 0 for equations of state without any.
template <class Eos>
inline constexpr auto eos_places = [] {
  std::array<std::size_t, Eos::parameters.size()> places{};
  for (std::size_t k = 0; k != places.size(); ++k)
    while (eos_parameters[places[k]].name != Eos::parameters[k].name) ++places[k];
  return places;
}();

/// The equation of state of a material with this density [kg/m^3] and bulk modulus of the elastic constants [Pa].
/// values: in the order of `eos_parameters`.
template <class Eos>
Eos make_eos(double density, double bulk_modulus, double const* values) {
  constexpr auto places = eos_places<Eos>;  // a copy: objects of several backends must not share a symbol
  std::array<double, Eos::parameters.size()> own{};
  for (std::size_t k = 0; k != own.size(); ++k) own[k] = values[places[k]];
  return Eos(density, bulk_modulus, own.data());
}

}  // namespace piola::inline PIOLA_BACKEND
