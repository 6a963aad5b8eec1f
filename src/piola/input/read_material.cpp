// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/sections.hpp"
#include <algorithm>

namespace piola {
namespace {

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (LawInfo const& law : laws()) names.emplace_back(law.name);
  return names;
}

std::vector<std::string> formulation_names() {
  std::vector<std::string> names;
  for (FormulationInfo const& formulation : formulations()) names.emplace_back(formulation.name);
  return names;
}

std::string about_parameter(Parameter const& parameter) {
  std::string text(parameter.meaning);
  if (parameter.unit != "1") text += ", in " + std::string(parameter.unit);
  std::string const allowed = interval_text(parameter.allowed);
  return allowed.empty() ? text : text + ", " + allowed;
}

std::optional<double> read_parameter(Node const& table, std::string const& section, Parameter const& parameter,
                                     Problems& problems) {
  Node const* const node = table.find(parameter.name);
  if (node == nullptr) return std::nullopt;
  return read_number({*node, section + "." + std::string(parameter.name)}, parameter.unit, parameter.allowed, problems);
}

}  // namespace

void read_material(Section const& section, BodySpec& body) {
  auto const value = section.find("law");
  if (!value) return;
  auto const name = read_word(*value, law_names(), section.problems());
  if (!name) return;
  LawInfo const law = *find_law(*name);
  body.law = *name;
  body.material.law = law.index;
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    Parameter const& parameter = law.parameters[i];
    std::string const key(parameter.name);
    keys.push_back(key);
    body.material.value[i] = parameter.required() ? 0 : parameter.default_value;
    if (auto const number = read_parameter(section.node(), "body.material", parameter, section.problems())) {
      body.material.value[i] = *number;
    } else if (parameter.required() && !section.has(key)) {
      std::string const example = parameter.unit == "1" ? "..." : "\"... " + std::string(parameter.unit) + "\"";
      section.report_missing(key, about_parameter(parameter), key + " = " + example);
    }
  }
  section.refuse_unknown(keys);
}

void read_formulation_formulas(Section const& section, std::span<FormulaInfo const> formulas, Names const& names,
                               FormulationSpec& spec) {
  for (FormulaInfo const& info : formulas) {
    Node const* const node = section.node().find(info.name);
    if (node == nullptr) continue;
    Names known = names;
    known.variables = to_strings(info.variables);
    Value const value{*node, "body.formulation." + std::string(info.name)};
    if (auto formula = read_formula(value, "", known, section.problems()))
      spec.formulas.emplace(info.name, std::move(*formula));
  }
}

FormulationSpec read_formulation(Section const& section, Names const& names) {
  FormulationSpec spec;
  auto const value = section.find("name");
  if (!value) return spec;
  auto const name = read_word(*value, formulation_names(), section.problems());
  if (!name) return spec;
  spec.name = *name;
  FormulationInfo const info = *find_formulation(*name);
  std::vector<std::string> keys;
  for (Parameter const& parameter : info.parameters) {
    keys.emplace_back(parameter.name);
    auto const number = read_parameter(section.node(), "body.formulation", parameter, section.problems());
    if (number) spec.numbers.emplace(parameter.name, *number);
  }
  for (Choice const& choice : info.choices) {
    keys.emplace_back(choice.name);
    Node const* const node = section.node().find(choice.name);
    if (node == nullptr) continue;
    Value const word{*node, "body.formulation." + std::string(choice.name)};
    if (auto const text = read_word(word, to_strings(choice.allowed), section.problems())) {
      spec.words.emplace(choice.name, *text);
    }
  }
  read_formulation_formulas(section, info.formulas, names, spec);
  for (FormulaInfo const& formula : info.formulas) keys.emplace_back(formula.name);
  section.refuse_unknown(keys);
  return spec;
}

}  // namespace piola
