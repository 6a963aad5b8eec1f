// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/library.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>

namespace piola {
namespace {

// Names by a section of a paper, and by a test.
constexpr std::array renamed{RenamedMaterial{"aluminium_adaptle_3_2", "aluminium_perfectly_plastic"},
                             RenamedMaterial{"steel_adaptle_3_3", "steel_linear_hardening"},
                             RenamedMaterial{"aluminium_adaptle_3_3", "aluminium_spall"},
                             RenamedMaterial{"copper_taylor_bar", "copper_linear_hardening"}};

}  // namespace

std::string_view checked_text(Checked checked) { return checked_words[static_cast<std::size_t>(checked)]; }

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

LibraryMaterial const* MaterialLibrary::find(std::string_view name) const {
  for (LibraryMaterial const& material : materials)
    if (material.name == name) return &material;
  return nullptr;
}

LibrarySource const* MaterialLibrary::find_source(std::string_view key) const {
  for (LibrarySource const& source : sources)
    if (source.key == key) return &source;
  return nullptr;
}

std::vector<LibrarySource> MaterialLibrary::sources_of(LibraryMaterial const& material) const {
  std::vector<LibrarySource> found;
  for (LibraryNumber const& given : material.numbers) {
    bool const known = std::any_of(found.begin(), found.end(),
                                   [&](LibrarySource const& source) { return source.key == given.source; });
    if (known) continue;
    LibrarySource const* const source = find_source(given.source);
    PIOLA_EXPECTS(source != nullptr);
    found.push_back(*source);
  }
  return found;
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
