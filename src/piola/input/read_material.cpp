// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/input/case_files.hpp"
#include "piola/input/law_settings.hpp"
#include "piola/input/sections.hpp"
#include "piola/materials/block_law.hpp"
#include "piola/materials/law_library.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola {
namespace {

std::vector<std::string> formulation_names() {
  std::vector<std::string> names;
  for (FormulationInfo const& formulation : formulations()) names.emplace_back(formulation.name);
  return names;
}

std::vector<std::string> material_names(MaterialLibrary const& library) {
  std::vector<std::string> names;
  for (LibraryMaterial const& material : library.materials) names.push_back(material.name);
  return names;
}

std::string about_parameter(Parameter const& parameter) {
  std::string text(parameter.meaning);
  if (parameter.unit != "1") text += ", in " + std::string(parameter.unit);
  std::string const allowed = interval_text(parameter.allowed);
  return allowed.empty() ? text : text + ", " + allowed;
}

std::optional<double> read_parameter(Section const& section, Parameter const& parameter) {
  Node const* const node = section.node().find(parameter.name);
  if (node == nullptr) return std::nullopt;
  return read_number({*node, section.name_of(parameter.name)}, parameter.unit, parameter.allowed, section.problems());
}

/// Text of the first fault in the rows of a law's table; empty: none.
std::string problem_of_table(TableParameter const& table, TablePoints const& points) {
  std::size_t const rows = points.x.size();
  if (rows > LawTable::most)
    return fmt::format("has {} rows (allowed: 2 to {}) - keep the rows where the slope changes", rows, LawTable::most);
  if (points.x.front() != 0)
    return fmt::format("begins at the {} {} (allowed: 0) - add a row for 0, or subtract the first from all",
                       table.argument, quantity_text(points.x.front(), table.unit_of_argument));
  if (!(points.y.front() > 0))
    return fmt::format("begins with the {} {} (allowed: above 0) - correct it", table.value,
                       quantity_text(points.y.front(), table.unit));
  for (std::size_t k = 1; k < rows; ++k)
    if (points.y[k] < points.y[k - 1])
      return fmt::format(
          "falls from {} to {} at the {} {} (allowed: values that do not fall) - end the table at its "
          "maximum; damage describes what follows",
          quantity_text(points.y[k - 1], table.unit), quantity_text(points.y[k], table.unit), table.argument,
          quantity_text(points.x[k], table.unit_of_argument));
  return "";
}

/// Reads the words and numbers of one material; those of the library come first, if it has a name. `keys`: the others
/// of a table of a library file; empty in a case.
class MaterialReader {
 public:
  MaterialReader(Section const& section, LawInfo const& law, LibraryMaterial const* base,
                 std::vector<std::string> keys = {})
      : section_(section), law_(law), base_(base), in_library_(!keys.empty()), keys_(std::move(keys)) {
    if (base != nullptr) material_ = parameters_of(*base);
    material_.law = law.index;
  }

  MaterialParameters read() {
    std::size_t const before = section_.problems().count();
    for (std::size_t i = 0; i < law_.choices.size(); ++i) read_choice(i);
    for (std::size_t i = 0; i < law_.parameters.size(); ++i) read_value(i);
    if (law_.table != nullptr) read_law_table(*law_.table);
    section_.refuse_unknown(keys_);
    check_spall();
    check_vaporisation();
    if (law_.block != nullptr && section_.problems().count() == before) check_as_a_whole();
    return material_;
  }

 private:
  void read_choice(std::size_t i) {
    Choice const& choice = law_.choices[i];
    keys_.emplace_back(choice.name);
    Node const* const node = section_.node().find(choice.name);
    if (node == nullptr) return;
    Value const value{*node, section_.name_of(choice.name)};
    auto const word = read_word(value, to_strings(choice.allowed), section_.problems());
    if (word) material_.word[i] = index_of(choice, *word);
    if (!word) unclear_.push_back(choice.name);
  }

  bool unclear(Parameter const& parameter) const {
    return std::find(unclear_.begin(), unclear_.end(), parameter.when.choice) != unclear_.end();
  }

  void read_value(std::size_t i) {
    Parameter const& parameter = law_.parameters[i];
    std::string const key(parameter.name);
    bool const given = section_.has(key), counts = applies(law_, parameter, material_) || unclear(parameter);
    if (counts || given) keys_.push_back(key);
    if (given && !counts) return report_useless(parameter);
    bool const from_library = base_ != nullptr && base_->number(key);
    if (!from_library) material_.value[i] = parameter.required() ? 0 : parameter.default_value;
    if (auto const number = read_parameter(section_, parameter)) {
      material_.value[i] = *number;
    } else if (parameter.required() && !given && counts && !unclear(parameter) && !from_library) {
      section_.report_missing(key, about_parameter(parameter), key + " = " + example_of(parameter));
    }
  }

  void read_law_table(TableParameter const& table) {
    keys_.emplace_back(table.name);
    auto const value = given_table(table);
    if (!value) return;
    auto const points = read_table_points(*value, {table.unit_of_argument, table.unit}, section_.problems());
    if (!points) return;
    if (std::string const wrong = problem_of_table(table, *points); !wrong.empty())
      return section_.problems().add(value->node.place, value->name + " " + wrong);
    material_.table.count = static_cast<int>(points->x.size());
    std::copy(points->x.begin(), points->x.end(), material_.table.x);
    std::copy(points->y.begin(), points->y.end(), material_.table.y);
  }

  std::optional<Value> given_table(TableParameter const& table) {
    std::string const key(table.name);
    if (in_library_) {
      section_.problems().add(section_.place(), fmt::format("{}: the law {} has a table, which library files cannot "
                                                            "hold - give law and {} in the case",
                                                            section_.name(), law_.name, key));
    } else if (Node const* const node = section_.node().find(key)) {
      return Value{*node, section_.name_of(key)};
    } else {
      section_.report_missing(key, fmt::format("rows of {} and {}, or a CSV file", table.argument, table.value),
                              fmt::format("{} = [[0, \"... {}\"], [0.1, \"... {}\"]], or {{ file = \"...\" }}", key,
                                          table.unit, table.unit));
    }
    return std::nullopt;
  }

  std::string example_of(Parameter const& parameter) const {
    std::string const number = parameter.unit == "1" ? "..." : "\"... " + std::string(parameter.unit) + "\"";
    return in_library_ ? "{ value = " + number + ", source = \"...\", checked = \"read\" }" : number;
  }

  void check_as_a_whole() {
    std::string const problem = problem_of_block_law(material_);
    if (problem.empty()) return;
    section_.problems().add(section_.place(), fmt::format("{}: the law {} refuses its parameters: {} - change them",
                                                          section_.name(), law_.name, problem));
  }

  /// Failure by spall needs a stress at which it comes.
  void check_spall() {
    auto const place = [](auto const& list, std::string_view name) {
      return std::find_if(list.begin(), list.end(), [&](auto const& item) { return item.name == name; });
    };
    auto const choice = place(law_.choices, "spall");
    auto const limit = place(law_.parameters, "spall_pressure");
    if (choice == law_.choices.end() || limit == law_.parameters.end()) return;
    auto const word = static_cast<std::size_t>(material_.word[choice - law_.choices.begin()]);
    if (word == 0 || material_.value[limit - law_.parameters.begin()] < unbounded) return;
    section_.problems().add(
        section_.place_of("spall"),
        fmt::format("{} = \"{}\" needs spall_pressure, which has no limit here - give it, or spall = \"limit\"",
                    section_.name_of("spall"), choice->allowed[word]));
  }

  /// Tillotson's equation of state weights two states between two energies.
  void check_vaporisation() {
    double begins = 0, ends = 0;
    for (std::size_t i = 0; i < law_.parameters.size(); ++i) {
      if (law_.parameters[i].name == "tillotson_eiv") begins = material_.value[i];
      if (law_.parameters[i].name == "tillotson_ecv") ends = material_.value[i];
    }
    if (begins == 0 || ends == 0 || ends > begins) return;
    section_.problems().add(
        section_.place_of("tillotson_ecv"),
        fmt::format("{} is {} (allowed: above tillotson_eiv, which is {}) - correct one of the two",
                    section_.name_of("tillotson_ecv"), quantity_text(ends, "J/kg"), quantity_text(begins, "J/kg")));
  }

  void report_useless(Parameter const& parameter) {
    std::string const words = condition_text(parameter.when);
    section_.problems().add(
        section_.place_of(parameter.name),
        section_.name_of(parameter.name) + " does not count here (it needs " + words + ") - remove it or set " + words);
  }

  Section const& section_;
  LawInfo law_;
  LibraryMaterial const* base_;
  bool in_library_;
  MaterialParameters material_;
  std::vector<std::string> keys_;
  std::vector<std::string_view> unclear_;  ///< choices whose word could not be read
};

/// Whether the material of the library has another name now, which is a problem of the case.
bool is_renamed(Value const& name, Problems& problems) {
  auto const now = renamed_material(name.node.text);
  if (!now) return false;
  problems.add(name.node.place, fmt::format("{} {} is now {} - write name = {}", name.name, in_quotes(name.node.text),
                                            in_quotes(*now), in_quotes(*now)));
  return true;
}

/// The law of the key `law`, or of the material of the library that the key `name` names.
std::optional<std::string> law_name(Section const& section, CaseLibrary const& own, LibraryMaterial const*& base) {
  if (auto const name = section.find("name")) {
    MaterialLibrary const& library = own ? *own : material_library();
    section.refuse("law", "is that of the material of the library when \"name\" is given");
    base = library.find(name->node.text);
    if (base == nullptr && is_renamed(*name, section.problems())) return std::nullopt;
    auto const word = read_word(*name, material_names(library), section.problems());
    if (!word) return std::nullopt;
    return base->law;
  }
  if (auto const law = section.find("law")) return read_word(*law, law_names(), section.problems());
  section.report_missing("law", "name of the law; or \"name\", a material of the library", "law = \"...\"");
  return std::nullopt;
}

/// The law of a library of the user's: the one of the key `name`, or the only one.
std::optional<LawInfo> law_of_library(Section const& section, Value const& library) {
  section.refuse("law", "is that of the library when \"library\" is given");
  if (!read_text(library, section.problems())) return std::nullopt;
  std::vector<LawInfo> laws;
  try {
    laws = load_laws(case_file(library.node).path);
  } catch (LawLibraryError const& error) {
    section.problems().add(library.node.place, library.name + ": " + error.what());
    return std::nullopt;
  }
  std::vector<std::string> names;
  for (LawInfo const& law : laws) names.emplace_back(law.block->name);
  auto const name = section.find("name");
  if (!name && laws.size() == 1) return laws[0];
  if (!name) {
    section.report_missing("name", "which law of the library: " + joined(names), "name = " + in_quotes(names[0]));
    return std::nullopt;
  }
  auto const word = read_word(*name, names, section.problems());
  if (!word) return std::nullopt;
  return laws[static_cast<std::size_t>(std::find(names.begin(), names.end(), *word) - names.begin())];
}

/// Reports settings of earlier versions. Returns their keys.
std::vector<std::string> refuse_removed(Section const& section, std::span<RemovedSetting const> removed) {
  std::vector<std::string> keys;
  for (RemovedSetting const& setting : removed) {
    Node const* const node = section.node().find(setting.key);
    if (node == nullptr || (!setting.word.empty() && node->text != setting.word)) continue;
    std::string const what = "body.formulation." + std::string(setting.key);
    section.problems().add(node->place, setting.word.empty() ? fmt::format("{} was removed - {}", what, setting.advice)
                                                             : fmt::format("{} = {} was removed - {}", what,
                                                                           in_quotes(setting.word), setting.advice));
    keys.emplace_back(setting.key);
  }
  return keys;
}

}  // namespace

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (LawInfo const& law : laws()) names.emplace_back(law.name);
  return names;
}

MaterialParameters read_law_values(Section const& section, LawInfo const& law, std::vector<std::string> keys) {
  return MaterialReader(section, law, nullptr, std::move(keys)).read();
}

void read_material(Section const& section, CaseLibrary const& library, BodySpec& body) {
  LibraryMaterial const* base = nullptr;
  std::optional<LawInfo> law;
  if (auto const own = section.find("library"))
    law = law_of_library(section, *own);
  else if (auto const name = law_name(section, library, base))
    law = find_law(*name);
  if (!law) return;
  body.law = law->name;
  body.material = MaterialReader(section, *law, base).read();
  if (base == nullptr) return;
  for (LibraryNumber const& number : base->numbers)
    if (number.place.line > 0 && !section.has(number.parameter))
      body.places["material." + number.parameter] = number.place;
}

MaterialParameters read_library_material(std::string const& library, std::string const& law,
                                         std::span<std::string const> settings) {
  Problems problems;
  std::vector<std::string> all(settings.begin(), settings.end());
  all.insert(all.begin(), "library=" + in_quotes(library));
  if (!law.empty()) all.push_back("name=" + in_quotes(law));
  Document document;
  document.root.place.file = "command line";  // paths start from the present folder
  apply_overrides(document, all, problems);
  problems.raise_if_any();
  BodySpec body;
  read_material(Section(document.root, "body.material", problems), {}, body);
  problems.raise_if_any();
  return body.material;
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
  std::vector<std::string> keys, removed = refuse_removed(section, info.removed);
  for (Parameter const& parameter : info.parameters) {
    keys.emplace_back(parameter.name);
    auto const number = read_parameter(section, parameter);
    if (number) spec.numbers.emplace(parameter.name, *number);
  }
  for (Choice const& choice : info.choices) {
    Node const* const node = section.node().find(choice.name);
    keys.emplace_back(choice.name);
    if (node == nullptr || std::find(removed.begin(), removed.end(), choice.name) != removed.end()) continue;
    Value const word{*node, "body.formulation." + std::string(choice.name)};
    if (auto const text = read_word(word, to_strings(choice.allowed), section.problems())) {
      spec.words.emplace(choice.name, *text);
    }
  }
  read_formulation_formulas(section, info.formulas, names, spec);
  for (FormulaInfo const& formula : info.formulas) keys.emplace_back(formula.name);
  section.refuse_unknown(keys, removed);
  return spec;
}

}  // namespace piola
