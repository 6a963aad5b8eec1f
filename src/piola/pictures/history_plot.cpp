// SPDX-License-Identifier: Apache-2.0
#include "piola/pictures/history_plot.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/formulations/field_signs.hpp"
#include "piola/formulations/quantity_names.hpp"
#include "piola/formulations/registry.hpp"
#include "piola/input/history_names.hpp"
#include "piola/input/probe_kinds.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/history.hpp"
#include "piola/pictures/rounding_levels.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace piola {
namespace {

/// Columns of runs with contact, ties or springs, of any formulation. A field may have the same name with another unit.
constexpr std::array<std::pair<std::string_view, std::string_view>, 10> meeting_columns{{{"contact_energy", "J"},
                                                                                         {"contact_overlap", "1"},
                                                                                         {"contact_points", "1"},
                                                                                         {"friction_heat", "J"},
                                                                                         {"chatter_damping_loss", "J"},
                                                                                         {"tie_energy", "J"},
                                                                                         {"tie_dissipation", "J"},
                                                                                         {"tie_failed_fraction", "1"},
                                                                                         {"spring_energy", "J"},
                                                                                         {"dashpot_loss", "J"}}};

HistoryTable history_of(std::filesystem::path const& folder) {
  HistoryTable table = read_history(folder / "history.csv");
  if (table.columns.empty())
    throw InputError(fmt::format(
        "{}: holds no history.csv (the folder of a run is needed) - give the folder that 'piola run' wrote to",
        folder.string()));
  if (table.rows.empty())
    throw InputError(fmt::format("{}: history.csv has no row yet - wait for the first one", folder.string()));
  return table;
}

std::vector<std::string> names_of(HistoryTable const& table) {
  std::vector<std::string> names;
  for (HistoryColumn const& column : table.columns) names.push_back(column.name);
  return names;
}

/// Kinetic and strain energy, their sum, the work from outside, and whatever took energy, as far as it is not zero.
std::vector<std::string> ledger(HistoryTable const& table) {
  std::vector<std::string> columns{"total_energy", "kinetic_energy", "strain_energy"};
  for (HistoryColumn const& column : table.columns) {
    bool const whole = column.name.find('.') == std::string::npos;
    bool const booked = column.name == "external_work" || column.name == "plastic_work" ||
                        column.name == "contact_energy" || column.name == "radiated_energy" ||
                        column.name.ends_with("_loss") || column.name.ends_with("_heat") ||
                        column.name.ends_with("_dissipation");
    if (!whole || !booked) continue;
    auto const values = table.values(column.name);
    if (std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v) && std::abs(v) > 0; }))
      columns.push_back(column.name);
  }
  return columns;
}

void add_curves(Plot& plot, HistoryTable const& table, std::string const& run, int number, std::string const& against,
                std::vector<std::string> const& columns) {
  for (std::size_t c = 0; c < columns.size(); ++c)
    plot.curves.push_back({.label = column_words(columns[c]) + (run.empty() ? "" : ", " + run),
                           .x = table.values(against),
                           .y = table.values(columns[c]),
                           .colour = static_cast<int>(c),
                           .dash = number});
}

/// The common unit of all columns; empty if their units differ.
std::string common_unit(std::vector<std::string> const& columns) {
  std::string const unit = unit_of_column(columns.front());
  bool const same = std::all_of(columns.begin(), columns.end(),
                                [&](std::string const& name) { return unit_of_column(name) == unit; });
  if (same) return unit;
  throw InputError(
      fmt::format("the columns {} have different units and share no axis - draw them one by one", joined(columns)));
}

/// The sign convention that all columns have; "" if they differ.
std::string common_sign(std::vector<std::string> const& columns) {
  std::string const sign = sign_of_column(columns.front());
  bool const same = std::all_of(columns.begin(), columns.end(),
                                [&](std::string const& name) { return sign_of_column(name) == sign; });
  return same ? sign : "";
}

std::string axis_name(std::vector<std::string> const& columns, bool as_ledger) {
  if (as_ledger) return "energy";
  std::string const name = columns.size() == 1 ? column_words(columns.front()) : "value", sign = common_sign(columns);
  return sign.empty() ? name : fmt::format("{}, {}", name, sign);
}

/// Curves of columns that hold nothing but round-off become zero.
void flatten_round_off(Plot& plot, RoundingLevels const& levels, std::vector<std::string> const& columns) {
  double level = 0;
  for (std::string const& name : columns) {
    if (!levels.is_rounding(name)) return;
    level = std::max(level, levels.of(name));
  }
  for (Curve& curve : plot.curves)
    for (double& y : curve.y)
      if (std::isfinite(y)) y = 0;
  plot.remark = fmt::format("zero to rounding (below {})", quantity_text(level, plot.y.unit, 2));
}

std::string run_name(std::filesystem::path folder) {
  if (!folder.has_filename()) folder = folder.parent_path();
  return folder.filename().string();
}

/// "Piola 0.1.0: Twisting column" begins log.txt.
std::string title_of(std::filesystem::path const& folder) {
  std::error_code error;
  if (!std::filesystem::exists(folder / "log.txt", error)) return run_name(folder);
  std::string const log = read_text_file(folder / "log.txt");
  std::string const first = log.substr(0, log.find('\n'));
  auto const colon = first.find(": ");
  return colon == std::string::npos ? run_name(folder) : first.substr(colon + 2);
}

}  // namespace

std::string unit_of_column(std::string const& name) {
  for (HistoryName const& known : history_names())
    if (known.name == name) return std::string(known.unit);
  for (FormulationInfo const& info : formulations())
    for (DiagnosticInfo const& known : info.diagnostics)
      if (known.name == name) return std::string(known.unit);
  for (auto const& [known, unit] : meeting_columns)
    if (known == name) return std::string(unit);
  std::string const word = name.substr(name.rfind('.') + 1);
  if (auto const quantity = find_quantity(word)) return quantity->unit;
  for (auto const& parts : {action_quantities(), rigid_quantities(), body_quantities()})
    for (PartQuantity const& part : parts)
      if (part.word == word) return std::string(part.unit);
  for (ProbeKindInfo const& kind : probe_kinds)  // several numbers of a kind share an axis, whatever their units
    if (kind.quantities.size() == 1 && kind.quantities[0].name == word) return std::string(kind.quantities[0].unit);
  return "";
}

std::string sign_of_column(std::string const& name) {
  if (name == "pressure_min" || name == "pressure_max") return std::string(sign_of("Pressure"));
  auto const quantity = find_quantity(name.substr(name.rfind('.') + 1));
  return quantity ? std::string(sign_of(quantity->field, quantity->component)) : "";
}

std::string missing_column(HistoryTable const& table, std::string const& column, std::filesystem::path const& folder) {
  if (table.find(column)) return "";
  auto const known = names_of(table);
  return fmt::format("{}: history.csv has no column {} (known: {}) - {}", folder.string(), in_quotes(column),
                     known_names_text(column, known), advice_for_name(column, known));
}

std::string column_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

Plot history_plot(std::filesystem::path const& folder, HistoryPlotOptions const& options) {
  HistoryTable const table = history_of(folder);
  auto const columns = options.columns.empty() ? ledger(table) : options.columns;
  std::vector<HistoryTable> others;
  for (auto const& other : options.with) others.push_back(history_of(other));
  std::string wrong;
  auto const look = [&](HistoryTable const& in, std::filesystem::path const& where) {
    auto asked = columns;
    asked.push_back(options.against);
    for (std::string const& name : asked)
      if (auto const problem = missing_column(in, name, where); !problem.empty()) wrong += problem + "\n";
  };
  look(table, folder);
  for (std::size_t k = 0; k < others.size(); ++k) look(others[k], options.with[k]);
  if (!wrong.empty()) throw InputError(wrong.substr(0, wrong.size() - 1));

  Plot plot;
  plot.title = title_of(folder);
  if (others.empty()) plot.note = run_name(folder);
  plot.x = {column_words(options.against), unit_of_column(options.against), options.log_x};
  plot.y = {axis_name(columns, options.columns.empty()), common_unit(columns), options.log_y};
  add_curves(plot, table, others.empty() ? "" : run_name(folder), 0, options.against, columns);
  if (others.empty() && !options.log_y) flatten_round_off(plot, RoundingLevels(table, folder), columns);
  for (std::size_t k = 0; k < others.size(); ++k)
    add_curves(plot, others[k], run_name(options.with[k]), static_cast<int>(k) + 1, options.against, columns);
  return plot;
}

}  // namespace piola
