// SPDX-License-Identifier: Apache-2.0
#include "piola/study/study_plot.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/pictures/history_plot.hpp"
#include "piola/study/study.hpp"
#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace piola {
namespace {

using StudyCells = std::vector<std::string>;

/// The cells of one line; one in quotes may hold commas and doubled quotes.
StudyCells cells_of(std::string_view line) {
  StudyCells cells(1);
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    bool const doubled = quoted && line.substr(k, 2) == "\"\"";
    if (line[k] == '"' && !doubled)
      quoted = !quoted;
    else if (line[k] == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += line[k];
    if (doubled) ++k;
  }
  return cells;
}

/// study.csv: folder, parameters, status, quantities.
struct StudyTable {
  std::filesystem::path path;
  StudyCells parameters, quantities;
  std::vector<StudyCells> rows;

  explicit StudyTable(std::filesystem::path file) : path(std::move(file)) {
    std::string const text = read_text_file(path);
    StudyCells head;
    for (std::size_t at = 0; at < text.size();) {
      std::size_t const end = std::min(text.find('\n', at), text.size());
      std::string_view const line = std::string_view(text).substr(at, end - at);
      at = end + 1;
      if (line.empty() || line.front() == '#') continue;
      StudyCells cells = cells_of(line);
      if (head.empty())
        head = std::move(cells);
      else if (cells.size() == head.size())
        rows.push_back(std::move(cells));
    }
    auto const status = std::find(head.begin(), head.end(), "status");
    if (head.empty() || head.front() != "folder" || status == head.end())
      throw InputError(
          fmt::format("{}: is no study.csv (folder, parameters, status and quantities are needed) - give "
                      "the folder that 'piola study' wrote to",
                      path.string()));
    parameters.assign(head.begin() + 1, status);
    quantities.assign(status + 1, head.end());
  }
  std::string const& value(StudyCells const& row, std::size_t parameter) const { return row[1 + parameter]; }
  bool completed(StudyCells const& row) const { return row[1 + parameters.size()] == "completed"; }
  std::string const& result(StudyCells const& row, std::size_t quantity) const {
    return row[2 + parameters.size() + quantity];
  }
};

std::size_t index_of(StudyCells const& known, std::string const& name, char const* what, StudyTable const& table) {
  auto const found = std::find(known.begin(), known.end(), name);
  if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
  throw InputError(fmt::format("{}: has no {} {} (known: {}) - {}", table.path.string(), what, in_quotes(name),
                               known_names_text(name, known), advice_for_name(name, known)));
}

/// The parameter of the horizontal axis.
std::size_t parameter_of(StudyTable const& table, std::string const& against) {
  if (!against.empty()) return index_of(table.parameters, against, "parameter", table);
  for (std::size_t p = 0; p < table.parameters.size(); ++p) {
    std::set<std::string> values;
    for (StudyCells const& row : table.rows) values.insert(table.value(row, p));
    if (values.size() > 1) return p;
  }
  return 0;
}

StudyCells chosen_quantities(StudyTable const& table, StudyCells const& asked) {
  if (!asked.empty()) return asked;
  if (table.quantities.size() == 1) return table.quantities;
  throw InputError(fmt::format("{}: has {} quantities - say which one to draw (known: {})", table.path.string(),
                               table.quantities.size(), joined(table.quantities)));
}

/// The unit behind the number of a text such as "2 mm"; "" if there is none.
std::string unit_behind(std::string const& text) {
  double number = 0;
  char const* const end = text.data() + text.size();
  auto const [rest, error] = std::from_chars(text.data(), end, number);
  std::string unit = error == std::errc() ? std::string(rest, end) : "";
  unit.erase(0, unit.find_first_not_of(' '));
  return unit;
}

/// Values of a parameter in the unit of the first one.
std::vector<double> parameter_values(StudyTable const& table, std::size_t parameter, std::string const& unit) {
  std::vector<double> numbers;
  for (StudyCells const& row : table.rows) {
    Quantity const value = read_quantity(table.value(row, parameter), unit.empty() ? "1" : unit);
    if (value.problem)
      throw InputError(
          fmt::format("{}: {} has the value {} (allowed: numbers and quantities of one kind) - draw "
                      "against another parameter with --against",
                      table.path.string(), table.parameters[parameter], in_quotes(table.value(row, parameter))));
    numbers.push_back(value.value);
  }
  return numbers;
}

/// Unit of a quantity by the summary of the first run with this quantity; "" if there is none.
std::string unit_of_quantity(StudyTable const& table, std::string const& name) {
  for (StudyCells const& row : table.rows) {
    std::filesystem::path folder = row.front();
    if (folder.is_relative() && !std::filesystem::exists(folder)) folder = table.path.parent_path() / folder;
    auto const summary = nlohmann::json::parse(summary_text(folder), nullptr, false);
    nlohmann::json::json_pointer const at("/quantities/" + name + "/unit");
    if (summary.is_object() && summary.contains(at) && summary[at].is_string()) return summary[at].get<std::string>();
  }
  return "";
}

/// Values in a row of the other parameters that change: "run.cfl=0.5".
std::string others_text(StudyTable const& table, StudyCells const& row, std::size_t parameter) {
  std::vector<std::string> texts;
  for (std::size_t p = 0; p < table.parameters.size(); ++p) {
    bool const changes = std::any_of(table.rows.begin(), table.rows.end(), [&](StudyCells const& other) {
      return table.value(other, p) != table.value(row, p);
    });
    if (p != parameter && changes) texts.push_back(table.parameters[p] + "=" + table.value(row, p));
  }
  return joined(texts);
}

/// The values of one quantity, by the other parameters, as points in the order of x.
std::map<std::string, std::map<double, double>> study_series(StudyTable const& table, std::size_t quantity,
                                                             std::size_t parameter, std::vector<double> const& x) {
  std::map<std::string, std::map<double, double>> series;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    StudyCells const& row = table.rows[r];
    Quantity const value = read_quantity(table.result(row, quantity), "1");
    if (table.completed(row) && !table.result(row, quantity).empty() && !value.problem)
      series[others_text(table, row, parameter)][x[r]] = value.value;
  }
  return series;
}

void add_series(Plot& plot, std::string const& name, std::map<std::string, std::map<double, double>> const& series) {
  for (auto const& [others, points] : series) {
    Curve curve{.label = others.empty() ? column_words(name) : column_words(name) + ", " + others,
                .x = {},
                .y = {},
                .colour = static_cast<int>(plot.curves.size() / 2)};
    for (auto const& [at, value] : points) {
      curve.x.push_back(at);
      curve.y.push_back(value);
    }
    plot.curves.push_back(curve);
    curve.label.clear();
    curve.marks = true;
    plot.curves.push_back(std::move(curve));
  }
}

}  // namespace

std::filesystem::path study_table_at(std::filesystem::path const& path) {
  std::error_code error;
  if (path.extension() == ".csv" && std::filesystem::is_regular_file(path, error)) return path;
  std::filesystem::path const inside = path / "study.csv";
  return std::filesystem::is_regular_file(inside, error) ? inside : std::filesystem::path();
}

Plot study_plot(std::filesystem::path const& table_file, StudyPlotOptions const& options) {
  StudyTable const table(table_file);
  if (table.rows.empty() || table.parameters.empty())
    throw InputError(fmt::format("{}: has no run - wait for the first one", table.path.string()));
  std::size_t const parameter = parameter_of(table, options.against);
  StudyCells const quantities = chosen_quantities(table, options.quantities);
  std::string const unit_of_x = unit_behind(table.value(table.rows.front(), parameter));
  auto const x = parameter_values(table, parameter, unit_of_x);
  Plot plot;
  std::filesystem::path const folder = table.path.parent_path();
  plot.title = folder.empty() ? table.path.stem().string() : folder.filename().string();
  plot.x = {table.parameters[parameter], unit_of_x, options.log_x};
  std::set<std::string> units;
  for (std::string const& name : quantities) {
    std::size_t const quantity = index_of(table.quantities, name, "quantity", table);
    units.insert(unit_of_quantity(table, name));
    add_series(plot, name, study_series(table, quantity, parameter, x));
  }
  if (units.size() > 1)
    throw InputError(fmt::format("the quantities {} have different units and share no axis - draw them one by one",
                                 joined(quantities)));
  if (plot.curves.empty())
    throw InputError(
        fmt::format("{}: no completed run has {} - see the column status", table.path.string(), joined(quantities)));
  plot.y = {quantities.size() == 1 ? column_words(quantities.front()) : "value", *units.begin(), options.log_y};
  return plot;
}

}  // namespace piola
