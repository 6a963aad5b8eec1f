// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/registry.hpp"
#include <optional>
#include <span>
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
std::string_view checked_text(Checked checked);

/// Source of numbers in the library.
struct LibrarySource {
  std::string_view key;   ///< short name, as `LibraryNumber::source` gives it
  std::string_view text;  ///< full reference
};

/// A word or a number of a material of the library, by the name of its choice or parameter.
struct LibraryWord {
  std::string_view choice, word;
};
struct LibraryNumber {
  std::string_view parameter;
  double value;             ///< SI
  std::string_view source;  ///< LibrarySource::key
  Checked checked;
};

/// A material that a case file names instead of giving a law and numbers: `material = { name = "steel_4340" }`.
struct LibraryMaterial {
  std::string_view name;
  std::string_view about;  ///< one line
  std::string_view range;  ///< for which rates, temperatures, pressures and shapes the numbers hold
  std::string_view lacks;  ///< effects that the material has and the set lacks; empty: none that matters in an impact
  std::string_view law;    ///< LawInfo::name
  std::span<LibraryWord const> words;
  std::span<LibraryNumber const> numbers;

  std::optional<std::string_view> word(std::string_view choice) const;
  std::optional<double> number(std::string_view parameter) const;
  /// Its sources, each once, in the order of its numbers.
  std::vector<LibrarySource> sources() const;
};

/// A material that had another name in earlier versions.
struct RenamedMaterial {
  std::string_view before, now;
};

std::span<LibraryMaterial const> material_library();
std::span<LibrarySource const> library_sources();
std::optional<LibraryMaterial> find_material(std::string_view name);
/// The present name of a material with the former name `name`.
std::optional<std::string_view> renamed_material(std::string_view name);

/// Law and numbers of a material of the library, completed by defaults.
MaterialParameters parameters_of(LibraryMaterial const& material);

}  // namespace piola
