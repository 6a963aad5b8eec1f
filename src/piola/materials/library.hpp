// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/errors.hpp"
#include "piola/materials/registry.hpp"
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// How a number of the library was checked against its source.
enum class Checked {
  read,    ///< in the source itself
  quoted,  ///< in another text or program that quotes it
  unread,  ///< not checked: entered from knowledge of the source
  chosen   ///< a choice, not a measurement
};
/// The words of library files for them, in their order.
inline constexpr std::array<std::string_view, 4> checked_words{"read", "quoted", "unread", "chosen"};
std::string_view checked_text(Checked checked);

/// Source of numbers in the library.
struct LibrarySource {
  std::string key;   ///< short name, as `LibraryNumber::source` gives it
  std::string text;  ///< full reference
};

/// A word or a number of a material of the library, by the name of its choice or parameter.
struct LibraryWord {
  std::string choice, word;
};
struct LibraryNumber {
  std::string parameter;
  double value = 0;    ///< SI
  std::string source;  ///< LibrarySource::key
  Checked checked = Checked::unread;
  Place place = {};  ///< in a file of the user
};

/// A material that a case file names instead of giving a law and numbers: `material = { name = "steel_4340" }`.
struct LibraryMaterial {
  std::string name;
  std::string about;  ///< one line
  std::string range;  ///< for which rates, temperatures, pressures and shapes the numbers hold
  std::string lacks;  ///< effects that the material has and the set lacks; empty: none that matters in an impact
  std::string law;    ///< LawInfo::name
  std::vector<LibraryWord> words;
  std::vector<LibraryNumber> numbers;

  std::optional<std::string_view> word(std::string_view choice) const;
  std::optional<double> number(std::string_view parameter) const;
};

/// Materials, and the sources of their numbers.
struct MaterialLibrary {
  std::vector<LibraryMaterial> materials;
  std::vector<LibrarySource> sources;

  LibraryMaterial const* find(std::string_view name) const;      ///< null if there is none
  LibrarySource const* find_source(std::string_view key) const;  ///< null if there is none
  /// Sources of a material, each once, in the order of its numbers.
  std::vector<LibrarySource> sources_of(LibraryMaterial const& material) const;
};

/// A material that had another name in earlier versions.
struct RenamedMaterial {
  std::string_view before, now;
};
/// The present name of a material with the former name `name`.
std::optional<std::string_view> renamed_material(std::string_view name);

/// Law and numbers of a material of the library, completed by defaults.
MaterialParameters parameters_of(LibraryMaterial const& material);

}  // namespace piola
