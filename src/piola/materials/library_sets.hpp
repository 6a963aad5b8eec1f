// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/library.hpp"
#include <array>

/// The sets of the library by kind of material, one file each; library.cpp puts them together.
namespace piola::library {

using enum Checked;

std::span<LibraryMaterial const> steels();
std::span<LibraryMaterial const> aluminium_alloys();
std::span<LibraryMaterial const> other_metals();
std::span<LibraryMaterial const> high_rate_metals();
std::span<LibraryMaterial const> non_metals();
std::span<LibraryMaterial const> brittle();
std::span<LibraryMaterial const> explosives();

inline constexpr std::array with_gas{LibraryWord{"eos", "stiffened_gas"}};
inline constexpr std::array with_shock{LibraryWord{"eos", "mie_grueneisen"}};
inline constexpr std::array with_polynomial{LibraryWord{"eos", "polynomial"}};
inline constexpr std::array with_shock_and_damage{LibraryWord{"eos", "mie_grueneisen"},
                                                  LibraryWord{"damage", "johnson_cook"}};

/// E of a shear modulus and a bulk modulus [Pa]; the source is that of the shear modulus.
constexpr LibraryNumber youngs_of(double shear, double bulk, std::string_view source, Checked checked) {
  return {"youngs_modulus", 9 * bulk * shear / (3 * bulk + shear), source, checked};
}
/// nu of the two; the source is that of the bulk modulus.
constexpr LibraryNumber poissons_of(double shear, double bulk, std::string_view source, Checked checked) {
  return {"poissons_ratio", (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear), source, checked};
}

}  // namespace piola::library
