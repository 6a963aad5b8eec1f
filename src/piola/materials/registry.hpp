// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/parameter.hpp"
#include "piola/materials/law_table.hpp"
#include <optional>
#include <span>
#include <string_view>
#include <vector>

struct piola_material;

namespace piola {

/// Description of a law for the case reader, `piola describe` and the manual.
struct LawInfo {
  std::string_view name;        ///< key `law` of a case file
  std::string_view about;       ///< one line
  std::string_view validity{};  ///< range of strains and rotations, errors beyond; empty: the law itself sets no bound
  std::span<Parameter const> parameters{};
  bool volumetric_split = false;  ///< energy: isochoric part plus kappa/2 (J - 1)^2
  bool small_strain = false;      ///< stress from the displacement gradient, without rotation
  bool hypoelastic = false;       ///< a solid in rate form (hypoelastic_solid.hpp), else a hyperelastic law
  bool elastic_rate = false;      ///< a hyperelastic law that also gives its stress rate (RateForm in laws.hpp)
  bool brittle = false;           ///< a solid whose damage is part of its strength
  std::span<Choice const> choices = {};
  TableParameter const* table = nullptr;  ///< the rows that the law needs; null: none
  piola_material const* block = nullptr;  ///< description of a law on blocks of points (block_law.hpp), whose first
                                          ///< parameter is the density; null: another law
  std::string_view library{};             ///< file of a law of the user's; empty: the law is Piola's
  int index = 0;                          ///< index in the registry, for MaterialParameters::law
};

/// A law with the values of its parameters: plain data, independent of the instruction set.
struct MaterialParameters {
  static constexpr int max_values = 64, max_words = 4;
  int law = 0;                 ///< LawInfo::index
  double value[max_values]{};  ///< in the order of LawInfo::parameters, SI
  int word[max_words]{};       ///< in the order of LawInfo::choices: which of the allowed words
  LawTable table{};            ///< of LawInfo::table, SI
};

/// The laws of Piola.
std::span<LawInfo const> laws();
/// Adds a law of a library, whose texts must stay, and returns it with its index; nullopt: there are too many. Not for
/// several threads at a time.
std::optional<LawInfo> add_law(LawInfo law);
/// The law of a material, also one of a library.
LawInfo const& law_of(MaterialParameters const& material);
/// Names of the laws for which `able` holds, in the order of the registry.
std::vector<std::string_view> laws_that(bool (*able)(LawInfo const&));
std::optional<LawInfo> find_law(std::string_view name);

/// Index of a word among those that a choice allows; -1 if not allowed.
int index_of(Choice const& choice, std::string_view word);
/// Whether a parameter has an effect with these words.
bool applies(LawInfo const& law, Parameter const& parameter, MaterialParameters const& material);

}  // namespace piola
