// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/registry.hpp"
#include <optional>
#include <span>
#include <string_view>

namespace piola {

/// A word or a number of a material of the library, by the name of its choice or parameter.
struct LibraryWord {
  std::string_view choice, word;
};
struct LibraryNumber {
  std::string_view parameter;
  double value;  ///< SI
};

/// A material that a case file names instead of giving a law and numbers: `material = { name = "steel_4340" }`.
struct LibraryMaterial {
  std::string_view name;
  std::string_view about;   ///< one line
  std::string_view source;  ///< where the numbers are from
  std::string_view law;     ///< LawInfo::name
  std::span<LibraryWord const> words;
  std::span<LibraryNumber const> numbers;

  std::optional<std::string_view> word(std::string_view choice) const;
  std::optional<double> number(std::string_view parameter) const;
};

std::span<LibraryMaterial const> material_library();
std::optional<LibraryMaterial> find_material(std::string_view name);

/// Law and numbers of a material of the library; what it does not give has its default.
MaterialParameters parameters_of(LibraryMaterial const& material);

}  // namespace piola
