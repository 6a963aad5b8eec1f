// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/case_schema.hpp"
#include "piola/base/version.hpp"
#include "piola/formulations/registry.hpp"
#include "piola/input/case_keys.hpp"
#include "piola/input/material_library.hpp"
#include "piola/materials/registry.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_text(Interval const& allowed) {
  Json schema{{"type", {"number", "string"}}};
  if (std::isfinite(allowed.low)) schema[allowed.low_open ? "exclusiveMinimum" : "minimum"] = allowed.low;
  if (std::isfinite(allowed.high)) schema[allowed.high_open ? "exclusiveMaximum" : "maximum"] = allowed.high;
  return schema;
}

Json one_of_words(std::span<std::string_view const> words) { return {{"type", "string"}, {"enum", words}}; }

Json reference_to(std::string_view section) { return {{"$ref", fmt::format("#/definitions/{}", section)}}; }

bool is_section(std::string_view name) {
  auto const sections = case_sections();
  return std::any_of(sections.begin(), sections.end(), [&](SectionInfo const& info) { return info.name == name; });
}

/// The section that the tables of a key belong to; empty if their keys are free.
std::string section_of(KeyInfo const& info) {
  constexpr std::array<std::string_view, 3> of_parts{"union", "difference", "intersection"};
  bool const is_part = std::find(of_parts.begin(), of_parts.end(), info.key) != of_parts.end();
  if (is_part || (info.section == "region" && info.key == "shape")) return "body.shape.part";
  std::string const key(info.key), own = info.section.empty() ? key : std::string(info.section) + "." + key;
  for (std::string const& name : {own, "body.shape." + key, "body." + key})
    if (is_section(name)) return name;
  return "";
}

/// Tables that may also stand in a list.
bool may_be_list(KeyInfo const& info) {
  return info.key == "contact" || (info.section == "body.shape.transform" && info.key == "rotate");
}

Json table_schema(KeyInfo const& info) {
  std::string const section = section_of(info);
  if (section.empty()) return {{"type", "object"}, {"additionalProperties", {{"type", {"number", "string"}}}}};
  Json const list{{"type", "array"}, {"items", reference_to(section)}};
  if (info.kind == KeyInfo::Kind::list) return list;
  if (may_be_list(info)) return {{"anyOf", {reference_to(section), list}}};
  return reference_to(section);
}

Json list_of(Json items, int least, int most) {
  return {{"type", "array"}, {"items", std::move(items)}, {"minItems", least}, {"maxItems", most}};
}

/// A formula; a table, too, if its value has a unit.
Json formula_schema(KeyInfo const& info, Json types) {
  Json formula{{"type", std::move(types)}};
  return info.unit.empty() ? formula : Json{{"anyOf", {std::move(formula), reference_to("table")}}};
}

/// Allowed values of a key, except words.
Json value_schema(KeyInfo const& info) {
  using enum KeyInfo::Kind;
  switch (info.kind) {
    case text:
    case name: return {{"type", "string"}};
    case word: return one_of_words(info.words);
    case quantity: return number_or_text(info.allowed);
    case whole: {
      Json schema = number_or_text(info.allowed);
      schema["type"] = "integer";
      return schema;
    }
    case flag: return {{"type", "boolean"}};
    case point: return list_of(number_or_text(info.allowed), 1, 3);
    case formula: return formula_schema(info, {"string", "number"});
    case formulas: return {{"type", "array"}, {"items", formula_schema(info, {"string", "number", "array"})}};
    case list: return section_of(info).empty() ? Json{{"type", "array"}} : table_schema(info);
    case table: return table_schema(info);
  }
  return Json::object();
}

std::string described(std::string meaning, std::string const& value, std::string const& standard) {
  if (!value.empty()) meaning += fmt::format(". Write {}", value);
  if (!standard.empty()) meaning += fmt::format(". Default: {}", standard);
  return meaning;
}

Json key_schema(KeyInfo const& info) {
  Json schema = value_schema(info);
  if (info.section == "output.pictures" || info.section == "output.pictures.panel")
    if (info.key == "as") schema = {{"anyOf", {schema, {{"type", "object"}, {"additionalProperties", schema}}}}};
  if (info.kind != KeyInfo::Kind::word && !info.words.empty())
    schema = {{"anyOf", {std::move(schema), one_of_words(info.words)}}};
  // In draft 7 other keys next to $ref are ignored.
  if (schema.contains("$ref")) schema = {{"allOf", {std::move(schema)}}};
  std::string const range = interval_text(info.allowed);
  schema["description"] = described(std::string(info.meaning), value_text(info) + (range.empty() ? "" : ", " + range),
                                    std::string(info.standard));
  return schema;
}

Json section_schema(SectionInfo const& section) {
  Json schema{{"type", "object"}, {"description", section.about}, {"properties", Json::object()}};
  Json required = Json::array();
  for (KeyInfo const& info : keys_of(section.name)) {
    schema["properties"][std::string(info.key)] = key_schema(info);
    if (info.required()) required.push_back(info.key);
  }
  if (!required.empty()) schema["required"] = required;
  schema["additionalProperties"] = false;
  return schema;
}

Json parameter_schema(Parameter const& parameter) {
  Json schema = number_or_text(parameter.allowed);
  std::string meaning(parameter.meaning);
  if (!parameter.when.always()) meaning += "; only with " + condition_text(parameter.when);
  std::string const value =
      parameter.unit == "1" ? "a number" : fmt::format("a number in {} or a text with a unit", parameter.unit);
  std::string standard(parameter.standard);
  if (standard.empty() && !parameter.required()) standard = fmt::format("{}", parameter.default_value);
  schema["description"] = described(meaning, value, standard);
  return schema;
}

void add_choices(std::span<Choice const> choices, Json& properties) {
  for (Choice const& choice : choices) {
    Json schema = one_of_words(choice.allowed);
    schema["description"] = described(std::string(choice.meaning), "", std::string(choice.allowed.front()));
    properties[std::string(choice.name)] = std::move(schema);
  }
}

Json table_schema(TableParameter const& table) {
  Json schema{{"type", {"array", "object"}}};
  schema["description"] =
      fmt::format("rows [{}, {} in {}], or {{ file = \"...\" }}", table.argument, table.value, table.unit);
  return schema;
}

/// A law with all of its keys, or a material of the library with this law.
Json law_schema(LawInfo const& law) {
  Json names = Json::array(), needed = {"law"}, properties = Json::object();
  for (LibraryMaterial const& material : material_library().materials)
    if (material.law == law.name) names.push_back(material.name);
  properties["law"] = {{"const", law.name}, {"description", law.about}};
  if (!names.empty())
    properties["name"] = {{"enum", names}, {"description", key_info("body.material", "name").meaning}};
  add_choices(law.choices, properties);
  for (Parameter const& parameter : law.parameters) {
    properties[std::string(parameter.name)] = parameter_schema(parameter);
    if (parameter.required() && parameter.when.always()) needed.push_back(parameter.name);
  }
  if (law.table != nullptr) {
    properties[std::string(law.table->name)] = table_schema(*law.table);
    needed.push_back(law.table->name);
  }
  Json schema{{"type", "object"},
              {"title", law.name},
              {"description", law.about},
              {"properties", std::move(properties)},
              {"additionalProperties", false}};
  schema["oneOf"] = {{{"required", needed}}, {{"required", {"name"}}}};
  return schema;
}

Json library_names() {
  Json names = Json::array();
  for (LibraryMaterial const& material : material_library().materials) names.push_back(material.name);
  return names;
}

/// A material of a file of the key `library`: its law is not known here.
Json own_material_schema() {
  return {{"type", "object"},
          {"title", "a material of a file of the key library"},
          {"properties", {{"name", {{"type", "string"}, {"not", {{"enum", library_names()}}}}}}},
          {"required", {"name"}},
          {"not", {{"required", {"law"}}}}};
}

/// Without the key `library`, bodies and parts of bodies name materials of the program.
Json names_without_library() {
  Json const material{{"properties", {{"name", {{"enum", library_names()}}}}}};
  Json const part{{"items", {{"properties", {{"material", material}}}}}};
  Json const body{{"items", {{"properties", {{"material", material}, {"part", part}}}}}};
  Json const of_library{{"required", {"library"}}}, of_program{{"properties", {{"body", body}}}};
  return Json::array({of_library, of_program});
}

Json formulation_schema(FormulationInfo const& info) {
  Json properties = Json::object();
  properties["name"] = {{"const", info.name}, {"description", info.about}};
  add_choices(info.choices, properties);
  for (Parameter const& parameter : info.parameters)
    properties[std::string(parameter.name)] = parameter_schema(parameter);
  for (FormulaInfo const& formula : info.formulas)
    properties[std::string(formula.name)] = {{"type", {"string", "number"}}, {"description", formula.meaning}};
  return {{"type", "object"},          {"title", info.name},
          {"description", info.about}, {"properties", std::move(properties)},
          {"required", {"name"}},      {"additionalProperties", false}};
}

template <class Items, class F>
Json any_of(Items const& items, F const& schema_of) {
  Json all = Json::array();
  for (auto const& item : items) all.push_back(schema_of(item));
  return {{"anyOf", std::move(all)}};
}

}  // namespace

std::string case_schema() {
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"},
              {"title", "Case file of Piola " + std::string(version())}};
  Json definitions = Json::object();
  for (SectionInfo const& section : case_sections()) {
    if (section.name.empty())
      schema.update(section_schema(section));
    else if (section.name == "body.material") {
      definitions["body.material"] = any_of(laws(), law_schema);
      definitions["body.material"]["anyOf"].push_back(own_material_schema());
    } else if (section.name == "body.formulation")
      definitions["body.formulation"] = any_of(formulations(), formulation_schema);
    else
      definitions[std::string(section.name)] = section_schema(section);
  }
  schema["anyOf"] = names_without_library();
  schema["definitions"] = std::move(definitions);
  return schema.dump(2) + "\n";
}

}  // namespace piola
