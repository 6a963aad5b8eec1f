// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/expression.hpp"
#include "piola/base/parameter.hpp"
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

class Problems;

/// A column of history.csv that only one formulation has.
struct DiagnosticInfo {
  std::string_view name;
  std::string_view unit;  ///< SI, UDUNITS notation
};

/// A formula that a user may give to a formulation.
struct FormulaInfo {
  std::string_view name;
  std::string_view meaning;
  std::span<std::string_view const> variables;  ///< allowed in addition to X, Y, Z, t
};

/// A key of earlier versions, or one word of a key that remains; refused with the advice.
struct RemovedSetting {
  std::string_view key, word;  ///< word: empty for the whole key
  std::string_view advice;     ///< what to do instead
};

/// Description of a formulation for the case reader, `piola describe` and the manual.
struct FormulationInfo {
  std::string_view name;                   ///< key `formulation.name` of a case file
  std::string_view about;                  ///< one line, with the paper
  std::span<Parameter const> parameters;   ///< optional numbers; a default of no_default means "set by `scheme`"
  std::span<Choice const> choices;         ///< optional words
  std::span<std::string_view const> laws;  ///< names of the laws it can use, without those of libraries
  std::span<DiagnosticInfo const> diagnostics = {};  ///< all columns of Diagnostics::more
  bool cracks = false;                               ///< whether bodies may have cracks
  bool mirrors = true;                               ///< whether bodies may have mirror planes
  bool off_lattice = true;        ///< whether bodies may be packed or arranged in rings instead of a lattice
  bool outline = false;           ///< whether it needs the outline of bodies: no points from files
  bool contact = false;           ///< whether it has kernel contact: contact rules and rigid shapes
  bool can_be_coupled = false;    ///< whether surface contact may push its bodies between steps
  bool parts = false;             ///< whether bodies may consist of parts of several materials
  bool cell_volumes = false;      ///< whether jittered particles get the volumes of their Voronoi cells
  bool surface_supports = false;  ///< whether supports can hold the surface itself, where particles lie inside
  bool minimises = false;         ///< whether it has Formulation::descend()
  bool axisymmetric = false;      ///< whether bodies may be axisymmetric
  bool block_laws = false;        ///< whether it can use laws of libraries (materials/block_law.hpp)
  bool conducts = false;          ///< whether heat is conducted, and temperatures may differ at the start
  bool absorbs = false;           ///< whether patches may be non-reflecting
  bool ranks = true;              ///< whether its bodies may be distributed over ranks
  std::span<FormulaInfo const> formulas = {};  ///< optional formulas
  std::span<RemovedSetting const> removed = {};
};

std::span<FormulationInfo const> formulations();
std::optional<FormulationInfo> find_formulation(std::string_view name);

/// Error message for a case that uses an unsupported feature. `what`: "cracks", "mirrors", "parts", "rings", "packed
/// clouds", "contact", "rigid shapes" or "axisymmetric bodies".
std::string refusal(FormulationInfo const& info, std::string_view what);
/// Error message for a run on several ranks of a formulation that runs on one.
std::string refusal_of_ranks(FormulationInfo const& info);

/// Settings of a formulation in a case file: only the given keys, checked against FormulationInfo.
struct FormulationSpec {
  std::string name;
  std::map<std::string, double, std::less<>> numbers;
  std::map<std::string, std::string, std::less<>> words;
  std::map<std::string, Expression, std::less<>> formulas = {};

  /// Whether this word is given for a choice.
  bool says(std::string_view choice, std::string_view word) const {
    auto const given = words.find(choice);
    return given != words.end() && given->second == word;
  }
};

/// The word given for a choice, else the first allowed one.
std::string_view word_of(FormulationSpec const& spec, std::span<Choice const> choices, std::string_view name);

/// As word_of(), as a value of an enumeration that lists the allowed words in their order.
template <class Enumeration>
Enumeration choice_of(FormulationSpec const& spec, std::span<Choice const> choices, std::string_view name) {
  std::string_view const word = word_of(spec, choices, name);
  for (Choice const& choice : choices)
    for (std::size_t k = 0; choice.name == name && k < choice.allowed.size(); ++k)
      if (choice.allowed[k] == word) return static_cast<Enumeration>(k);
  return {};
}

/// Whether the directions that a body does not have are free of stress, by the choice "assumption". `otherwise`: for
/// "as_dimension". Adds a problem if the assumption is for another dimension.
bool is_stress_free(std::string_view assumption, int dimension, bool otherwise, Problems& problems);

/// The number given for a parameter, else `otherwise`.
double number_of(FormulationSpec const& spec, std::string_view name, double otherwise);

}  // namespace piola
