// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/registry.hpp"
#include "piola/base/contracts.hpp"
#include "piola/materials/block/own_laws.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>
#include <array>

namespace piola {
namespace {

template <class... Law, class... Strength>
constexpr auto table(LawList<Law...>, StrengthList<Strength...>) {
  static_assert(((Law::parameters.size() <= MaterialParameters::max_values) && ...));
  static_assert(((SolidLaw<Strength>::parameters.size() <= MaterialParameters::max_values) && ...));
  int index = 0;
  return std::array{LawInfo{.name = Law::name,
                            .about = Law::about,
                            .validity = Law::validity,
                            .parameters = Law::parameters,
                            .volumetric_split = Law::volumetric_split,
                            .small_strain = Law::small_strain,
                            .elastic_rate = RateForm<Law>,
                            .index = index++}...,
                    LawInfo{.name = Strength::name,
                            .about = Strength::about,
                            .parameters = SolidLaw<Strength>::parameters,
                            .hypoelastic = true,
                            .brittle = Strength::brittle,
                            .choices = SolidLaw<Strength>::choices,
                            .table = SolidLaw<Strength>::table,
                            .index = index++}...};
}

/// The laws of Piola: hyperelastic ones, solids in rate form, then those that work on blocks of points.
std::vector<LawInfo> const& own_laws() {
  static std::vector<LawInfo> const all = [] {
    auto const templates = table(Laws{}, Strengths{});
    std::vector<LawInfo> list(templates.begin(), templates.end());
    for (LawInfo const* const law : block_laws::own_laws()) {
      list.push_back(*law);
      list.back().index = static_cast<int>(list.size()) - 1;
    }
    return list;
  }();
  return all;
}

/// Laws of libraries, whose indices follow those of Piola's laws.
struct AddedLaws {
  static constexpr std::size_t most = 64;
  std::array<LawInfo, most> laws{};
  std::size_t count = 0;
};

AddedLaws& added_laws() {
  static AddedLaws added;
  return added;
}

}  // namespace

std::span<LawInfo const> laws() { return own_laws(); }

std::optional<LawInfo> add_law(LawInfo law) {
  AddedLaws& added = added_laws();
  if (added.count == AddedLaws::most) return std::nullopt;
  law.index = static_cast<int>(own_laws().size() + added.count);
  return added.laws[added.count++] = law;
}

LawInfo const& law_of(MaterialParameters const& material) {
  auto const index = static_cast<std::size_t>(material.law);
  PIOLA_EXPECTS(index < own_laws().size() + added_laws().count);
  return index < own_laws().size() ? own_laws()[index] : added_laws().laws[index - own_laws().size()];
}

std::vector<std::string_view> laws_that(bool (*able)(LawInfo const&)) {
  std::vector<std::string_view> names;
  for (LawInfo const& law : own_laws())
    if (able(law)) names.push_back(law.name);
  return names;
}

std::optional<LawInfo> find_law(std::string_view name) {
  for (LawInfo const& law : own_laws())
    if (law.name == name) return law;
  return std::nullopt;
}

int index_of(Choice const& choice, std::string_view word) {
  PIOLA_EXPECTS(!choice.allowed.empty());
  auto const at = std::find(choice.allowed.begin(), choice.allowed.end(), word);
  return at == choice.allowed.end() ? -1 : static_cast<int>(at - choice.allowed.begin());
}

bool applies(LawInfo const& law, Parameter const& parameter, MaterialParameters const& material) {
  PIOLA_EXPECTS(law.choices.size() <= MaterialParameters::max_words);
  if (parameter.when.always()) return true;
  for (std::size_t i = 0; i < law.choices.size(); ++i) {
    auto const word = static_cast<std::size_t>(material.word[i]);
    PIOLA_EXPECTS(word < law.choices[i].allowed.size());
    if (law.choices[i].name == parameter.when.choice) return parameter.when.holds(law.choices[i].allowed[word]);
  }
  return false;
}

}  // namespace piola
