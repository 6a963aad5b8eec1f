// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/registry.hpp"
#include "piola/materials/laws.hpp"
#include <array>

namespace piola {
namespace {

template <class... Law>
constexpr auto table(LawList<Law...>) {
  static_assert(((Law::parameters.size() <= MaterialParameters::max_values) && ...));
  int index = 0;
  return std::array{LawInfo{Law::name, Law::about, Law::parameters, Law::volumetric_split, index++}...};
}

constexpr auto all = table(Laws{});

}  // namespace

std::span<LawInfo const> laws() { return all; }

std::optional<LawInfo> find_law(std::string_view name) {
  for (auto const& law : all)
    if (law.name == name) return law;
  return std::nullopt;
}

}  // namespace piola
