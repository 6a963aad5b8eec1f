// SPDX-License-Identifier: Apache-2.0
#include "manual.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/formulations/quantity_names.hpp"
#include "piola/formulations/registry.hpp"
#include "piola/input/case_keys.hpp"
#include "piola/input/history_names.hpp"
#include "piola/input/material_library.hpp"
#include "piola/kernels/registry.hpp"
#include "piola/materials/registry.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace piola::app {
namespace {

/// A row of a table of keys: key, allowed values, default, meaning.
struct Row {
  std::string key, value, standard, meaning;
};

std::string table_text(std::vector<Row> const& rows, Layout layout) {
  std::string text;
  if (layout == Layout::markdown) {
    text = "\n| key | value | default | meaning |\n|---|---|---|---|\n";
    for (Row const& row : rows) {
      text += fmt::format("| `{}` | {} | {} | {} |\n", row.key, row.value, row.standard, row.meaning);
    }
    return text;
  }
  std::size_t width = 0;
  for (Row const& row : rows) width = std::max(width, row.key.size());
  for (Row const& row : rows) {
    text += fmt::format("  {:<{}}  {}\n  {:<{}}  {}; {}\n", row.key, width, row.meaning, "", width, row.value,
                        row.standard);
  }
  return text;
}

std::string title(std::string const& text, int level, Layout layout) {
  if (layout == Layout::markdown) return "\n" + std::string(static_cast<std::size_t>(level), '#') + " " + text + "\n\n";
  return text + "\n";
}

std::string standard_text(std::string_view standard) {
  return standard.empty() ? "required" : "default: " + std::string(standard);
}

// For a table of the manual, whose column already has the title "default".
std::string in_column(std::string text, Layout layout) {
  constexpr std::string_view lead = "default: ";
  if (layout == Layout::markdown && text.starts_with(lead)) text.erase(0, lead.size());
  return text;
}

std::string value_with_range(std::string const& value, Interval const& allowed) {
  std::string const range = interval_text(allowed);
  return range.empty() ? value : value + ", " + range;
}

std::string default_text(Parameter const& parameter, bool optional) {
  if (parameter.required() && optional && !parameter.standard.empty())
    return "default: " + std::string(parameter.standard);
  if (parameter.required()) return optional ? "default: set by the other words" : "required";
  std::string const value(parameter.standard);
  return "default: " + (value.empty() ? number_text(parameter.default_value) : value);
}

Row row_of(Parameter const& parameter, bool optional, Layout layout) {
  std::string const unit =
      parameter.unit == "1" ? "a number" : "a number in " + std::string(parameter.unit) + " or a text with a unit";
  std::string meaning(parameter.meaning);
  if (!parameter.when.always()) meaning += "; only with " + condition_text(parameter.when);
  return {std::string(parameter.name), value_with_range(unit, parameter.allowed),
          in_column(default_text(parameter, optional), layout), meaning};
}

Row row_of(Choice const& choice, Layout layout) {
  return {std::string(choice.name), "one of " + joined(choice.allowed),
          in_column("default: \"" + std::string(choice.allowed.front()) + "\"", layout), std::string(choice.meaning)};
}

Row row_of(FormulaInfo const& formula, Layout layout) {
  std::string const more = formula.variables.empty() ? "" : ", " + joined(formula.variables);
  return {std::string(formula.name), "a formula in X, Y, Z, t" + more, in_column("default: none", layout),
          std::string(formula.meaning)};
}

Row row_of(KeyInfo const& info, Layout layout) {
  std::string const standard = in_column(standard_text(info.standard), layout);
  return {std::string(info.key), value_with_range(value_text(info), info.allowed), standard, std::string(info.meaning)};
}

Row row_of(TableParameter const& table, Layout layout) {
  return {std::string(table.name),
          fmt::format("rows [{}, {} in {}], up to {}, or {{ file = \"...\" }}", table.argument, table.value, table.unit,
                      LawTable::most),
          in_column("required", layout),
          fmt::format("{} over {}: begins at 0 and does not fall; straight between rows, the last one holds beyond; a "
                      "CSV file as of {{ table = [...] }}",
                      table.value, table.argument)};
}

std::string describe_law(LawInfo const& law, Layout layout) {
  std::vector<Row> rows;
  for (Choice const& choice : law.choices) rows.push_back(row_of(choice, layout));
  for (Parameter const& parameter : law.parameters) rows.push_back(row_of(parameter, false, layout));
  if (law.table != nullptr) rows.push_back(row_of(*law.table, layout));
  std::string const indent = layout == Layout::markdown ? "" : "  ";
  std::string valid(law.validity);
  if (!valid.empty()) valid = (layout == Layout::markdown ? "\n" : "") + indent + "Valid for " + valid + ".\n";
  return title(layout == Layout::markdown ? "law = \"" + std::string(law.name) + "\"" : std::string(law.name), 3,
               layout) +
         indent + std::string(law.about) + "\n" + valid + table_text(rows, layout);
}

std::string describe_kernel(Kernel const& kernel, Layout layout) {
  return title(std::string(kernel.name), 3, layout) + (layout == Layout::markdown ? "" : "  ") +
         std::string(kernel.about) + "\n";
}

std::string describe_formulation(FormulationInfo const& info, Layout layout) {
  std::vector<Row> rows;
  for (Choice const& choice : info.choices) rows.push_back(row_of(choice, layout));
  for (Parameter const& parameter : info.parameters) rows.push_back(row_of(parameter, true, layout));
  for (FormulaInfo const& formula : info.formulas) rows.push_back(row_of(formula, layout));
  std::vector<std::string> columns;
  for (DiagnosticInfo const& column : info.diagnostics) columns.emplace_back(column.name);
  std::string const indent = layout == Layout::markdown ? "" : "  ";
  return title(layout == Layout::markdown ? "name = \"" + std::string(info.name) + "\"" : std::string(info.name), 3,
               layout) +
         indent + std::string(info.about) + (layout == Layout::markdown ? ". " : "\n") + indent +
         "Laws that it can use: " + joined(info.laws) +
         (columns.empty() ? "" : (layout == Layout::markdown ? ". " : "\n" + indent)) +
         (columns.empty() ? "" : "Columns of history.csv that it adds: " + joined(columns)) + "\n" +
         table_text(rows, layout);
}

/// All items of a list, or the one with the name.
template <class Items, class DescribeOne>
std::string describe_some(Items const& items, std::string const& name, std::string_view kind,
                          DescribeOne const& describe_one) {
  std::string text;
  std::vector<std::string> known;
  for (auto const& item : items) {
    known.emplace_back(item.name);
    if (name.empty() || item.name == name) text += describe_one(item);
  }
  if (!text.empty()) return text;
  throw InputError("no " + std::string(kind) + " is named " + in_quotes(name) + " (known: " + joined(known) + ") - " +
                   advice_for_name(name, known));
}

std::string names_text(std::string const& heading, std::vector<std::string> const& names, Layout layout) {
  std::string text = title(heading, 2, layout);
  for (std::size_t i = 0; i < names.size(); ++i) {
    bool const mark = layout == Layout::markdown;
    text += (i > 0 ? ", " : mark ? "" : "  ") + (mark ? "`" + names[i] + "`" : names[i]);
  }
  return text + "\n";
}

std::string describe_section(SectionInfo const& section, Layout layout) {
  std::vector<Row> rows;
  for (KeyInfo const& info : keys_of(section.name)) rows.push_back(row_of(info, layout));
  std::string const heading = section.name.empty() ? "Top of the file" : std::string(section.heading);
  bool const markdown = layout == Layout::markdown;
  std::string const shown = markdown && !section.name.empty() ? "`" + heading + "`" : heading;
  std::string text =
      title(shown, 2, layout) + (markdown ? "" : "  ") + std::string(section.about) + "\n" + table_text(rows, layout);
  if (markdown && section.name == "body.material") text += describe_materials("", layout);
  if (markdown && section.name == "body.formulation") text += describe_formulations("", layout);
  return text + (markdown ? "" : "\n");
}

template <class Items>
std::string short_list(std::string_view heading, Items const& items) {
  std::size_t width = 0;
  for (auto const& item : items) width = std::max(width, item.name.size());
  std::string text = fmt::format("{}\n", heading);
  for (auto const& item : items) text += fmt::format("  {:<{}} {}\n", item.name, width, item.about);
  return text;
}

std::string all_names(Layout layout) {
  std::vector<std::string> columns, fields, quantities;
  for (HistoryName const& name : history_names()) columns.emplace_back(name.name);
  for (FieldName const& name : field_names()) fields.emplace_back(name.name);
  for (FieldQuantity const& quantity : all_quantities()) quantities.push_back(quantity.name);
  return names_text("Fields of frames and pictures", fields, layout) +
         names_text("Quantities of probes (kinds point, average, maximum, minimum)", quantities, layout) +
         names_text("Columns of history.csv", columns, layout);
}

}  // namespace

std::string describe_materials(std::string const& name, Layout layout) {
  std::string text;
  std::vector<std::string> known;
  for (LawInfo const& law : laws()) {
    known.emplace_back(law.name);
    if (name.empty() || name == law.name) text += describe_law(law, layout);
  }
  for (LibraryMaterial const& material : material_library().materials) {
    known.emplace_back(material.name);
    if (name == material.name) text += describe_set(material);
  }
  if (name.empty()) {
    text += title("Materials of the library, for the key name", 3, layout) +
            (layout == Layout::markdown ? "Numbers, sources, ranges: [materials.md](materials.md).\n\n" : "") +
            library_table(layout);
  }
  if (!text.empty()) return text;
  refuse_renamed(name);
  throw InputError("no law or material is named " + in_quotes(name) + " (known: " + known_names_text(name, known) +
                   ") - " + advice_for_name(name, known));
}

std::string describe_kernels(std::string const& name, Layout layout) {
  return describe_some(kernels(), name, "kernel",
                       [&](Kernel const& kernel) { return describe_kernel(kernel, layout); });
}

std::string describe_formulations(std::string const& name, Layout layout) {
  return describe_some(formulations(), name, "formulation",
                       [&](FormulationInfo const& info) { return describe_formulation(info, layout); });
}

std::string describe_case(std::string const& section, Layout layout) {
  std::string const text = describe_some(case_sections(), section, "section",
                                         [&](SectionInfo const& info) { return describe_section(info, layout); });
  return section.empty() ? text + all_names(layout) : text;
}

std::string overview() {
  return short_list("materials", laws()) + short_list("materials of the library", material_library().materials) +
         short_list("kernels", kernels()) + short_list("formulations", formulations()) +
         "piola describe material NAME, and so on, tells more; piola describe case lists the keys of a case file.\n";
}

std::string manual_page() {
  return "# Case file: all keys\n\n"
         "This page is written by `piola describe --markdown`; how to write a case file: see\n"
         "[case-file.md](case-file.md). A quantity is a number in SI units or a text with a unit (`\"17 MPa\"`). A "
         "formula is a\n"
         "text in `X`, `Y`, `Z` (reference position, m), `t` (time, s), `pi`, the `[constants]` and the names of "
         "`define`.\n" +
         describe_case("", Layout::markdown);
}

}  // namespace piola::app
