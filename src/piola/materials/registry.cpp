// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/registry.hpp"
#include "piola/materials/solids.hpp"
#include <array>

namespace piola {
namespace {

template <class... Law, class... Strength>
constexpr auto table(LawList<Law...>, StrengthList<Strength...>) {
  static_assert(((Law::parameters.size() <= MaterialParameters::max_values) && ...));
  static_assert(((SolidLaw<Strength>::parameters.size() <= MaterialParameters::max_values) && ...));
  int index = 0;
  return std::array{LawInfo{Law::name, Law::about, Law::parameters, Law::volumetric_split, false, {}, index++}...,
                    LawInfo{SolidLaw<Strength>::name, SolidLaw<Strength>::about, SolidLaw<Strength>::parameters, false,
                            true, SolidLaw<Strength>::choices, index++}...};
}

constexpr auto all = table(Laws{}, Strengths{});

}  // namespace

std::span<LawInfo const> laws() { return all; }

std::optional<LawInfo> find_law(std::string_view name) {
  for (auto const& law : all)
    if (law.name == name) return law;
  return std::nullopt;
}

}  // namespace piola
