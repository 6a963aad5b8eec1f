// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/library.hpp"
#include "piola/base/contracts.hpp"
#include "piola/materials/library_sets.hpp"
#include <algorithm>

namespace piola {
namespace {

// Names by a section of a paper, and by a test.
constexpr std::array renamed{RenamedMaterial{"aluminium_adaptle_3_2", "aluminium_perfectly_plastic"},
                             RenamedMaterial{"steel_adaptle_3_3", "steel_linear_hardening"},
                             RenamedMaterial{"aluminium_adaptle_3_3", "aluminium_spall"},
                             RenamedMaterial{"copper_taylor_bar", "copper_linear_hardening"}};

std::vector<LibraryMaterial> all_sets() {
  std::vector<LibraryMaterial> all;
  for (auto const& some :
       {library::steels(), library::aluminium_alloys(), library::other_metals(), library::high_rate_metals(),
        library::non_metals(), library::brittle(), library::explosives()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

LibrarySource source_of(std::string_view key) {
  auto const all = library_sources();
  auto const found =
      std::find_if(all.begin(), all.end(), [&](LibrarySource const& source) { return source.key == key; });
  PIOLA_EXPECTS(found != all.end());
  return *found;
}

}  // namespace

std::string_view checked_text(Checked checked) {
  switch (checked) {
    case Checked::read: return "read";
    case Checked::quoted: return "quoted";
    case Checked::unread: return "unread";
    default: return "chosen";
  }
}

std::optional<std::string_view> LibraryMaterial::word(std::string_view choice) const {
  for (LibraryWord const& given : words)
    if (given.choice == choice) return given.word;
  return std::nullopt;
}

std::optional<double> LibraryMaterial::number(std::string_view parameter) const {
  for (LibraryNumber const& given : numbers)
    if (given.parameter == parameter) return given.value;
  return std::nullopt;
}

std::vector<LibrarySource> LibraryMaterial::sources() const {
  std::vector<LibrarySource> found;
  for (LibraryNumber const& given : numbers) {
    bool const known = std::any_of(found.begin(), found.end(),
                                   [&](LibrarySource const& source) { return source.key == given.source; });
    if (!known) found.push_back(source_of(given.source));
  }
  return found;
}

std::span<LibraryMaterial const> material_library() {
  static std::vector<LibraryMaterial> const all = all_sets();
  return all;
}

std::optional<LibraryMaterial> find_material(std::string_view name) {
  for (LibraryMaterial const& material : material_library())
    if (material.name == name) return material;
  return std::nullopt;
}

std::optional<std::string_view> renamed_material(std::string_view name) {
  for (RenamedMaterial const& one : renamed)
    if (one.before == name) return one.now;
  return std::nullopt;
}

MaterialParameters parameters_of(LibraryMaterial const& material) {
  auto const found = find_law(material.law);
  PIOLA_EXPECTS(found.has_value());
  LawInfo const& law = *found;
  MaterialParameters values;
  values.law = law.index;
  for (std::size_t c = 0; c < law.choices.size(); ++c) {
    if (auto const word = material.word(law.choices[c].name)) values.word[c] = index_of(law.choices[c], *word);
    PIOLA_ENSURES(values.word[c] >= 0);
  }
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    Parameter const& parameter = law.parameters[i];
    double const otherwise = parameter.required() ? 0 : parameter.default_value;
    values.value[i] = material.number(parameter.name).value_or(otherwise);
  }
  return values;
}

}  // namespace piola
