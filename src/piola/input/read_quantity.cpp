// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/formulations/quantity_names.hpp"
#include "piola/formulations/registry.hpp"
#include "piola/input/contact_capabilities.hpp"
#include "piola/input/history_names.hpp"
#include "piola/input/observer_keys.hpp"
#include "piola/input/sections.hpp"
#include <array>

namespace piola {
namespace {

constexpr std::array contact_columns{std::pair{"contact_energy", "J"}, std::pair{"contact_overlap", "1"},
                                     std::pair{"contact_points", "1"}, std::pair{"friction_heat", "J"},
                                     std::pair{"chatter_damping_loss", "J"}};

using Statistic = QuantitySpec::Statistic;

struct Column {
  std::string name, unit;
};

void add_part(std::string const& name, std::span<PartQuantity const> quantities, std::vector<Column>& columns) {
  for (PartQuantity const& q : quantities) columns.push_back({name + "." + std::string(q.word), std::string(q.unit)});
}

/// Adds the columns of rigid shapes and their springs.
void add_rigid_columns(CaseSpec const& spec, std::vector<Column>& columns) {
  for (RigidSpec const& rigid : spec.rigids) {
    add_part(rigid.name, action_quantities(), columns);
    if (rigid.turns()) add_part(rigid.name, rigid_quantities(), columns);
  }
  if (!spec.springs.empty())
    for (char const* name : {"spring_energy", "dashpot_loss"}) columns.push_back({name, "J"});
  for (SpringSpec const& spring : spec.springs) add_part(spring.name, action_quantities(), columns);
}

std::vector<Column> columns_of(CaseSpec const& spec) {
  std::vector<Column> columns;
  for (HistoryName const& column : history_names())
    columns.push_back({std::string(column.name), std::string(column.unit)});
  for (FormulationInfo const& formulation : formulations_of(spec)) {
    for (DiagnosticInfo const& column : formulation.diagnostics)
      columns.push_back({std::string(column.name), std::string(column.unit)});
  }
  auto const add_all = [&](std::string const& name, std::span<PartQuantity const> quantities) {
    add_part(name, quantities, columns);
  };
  for (BodySpec const& body : spec.bodies)
    if (spec.bodies.size() > 1) add_all(body.name, body_quantities());
  for (SupportSpec const& support : spec.supports) add_all(support.name, action_quantities());
  for (LoadSpec const& load : spec.loads)
    if (!load.name.empty()) add_all(load.name, action_quantities());
  add_rigid_columns(spec, columns);
  if (bodies_are_pushed(spec)) {
    for (auto const& [name, unit] : contact_columns) columns.push_back({name, unit});
    for (std::size_t a = 0; a < spec.bodies.size(); ++a)
      for (std::size_t b = a + 1; b < spec.bodies.size(); ++b)
        if (pushed_by_surface(spec, a, b) || pushed_by_colour(spec, a, b))
          add_all(spec.bodies[a].name + "-" + spec.bodies[b].name, action_quantities());
  }
  if (!spec.ties.empty())
    for (auto const& [name, unit] :
         {std::pair{"tie_energy", "J"}, {"tie_dissipation", "J"}, {"tie_failed_fraction", "1"}})
      columns.push_back({name, unit});
  for (TieSpec const& tie : spec.ties) add_all(tie.name, action_quantities());
  for (ProbeSpec const& probe : spec.probes) {
    for (std::string const& quantity : probe.quantities) {
      columns.push_back({probe.name + "." + quantity, std::string(unit_of_probe_quantity(probe.kind, quantity))});
    }
  }
  return columns;
}

/// The unit of the column; nothing (and a problem) if no such column will be written.
std::optional<std::string> read_column(Section const& section, CaseSpec const& spec, std::string& name) {
  if (!section.read("column", name)) return std::nullopt;
  std::vector<std::string> known;
  for (Column const& column : columns_of(spec)) {
    if (column.name == name) return column.unit;
    known.push_back(column.name);
  }
  section.problems().add(
      section.place_of("column"),
      "quantity.column is " + in_quotes(name) + " (allowed: " + known_names_text(name, known) + ") - " +
          (nearest_name(name, known) ? advice_for_name(name, known) : "add a [[probe]] that records it"));
  return std::nullopt;
}

bool takes_time(Statistic take) { return needs_time(take) || take == Statistic::oscillation_period; }

bool compares(Statistic take) {
  return take == Statistic::mean_absolute_difference || take == Statistic::relative_error;
}

/// SI unit of the number that is taken from a column.
std::string unit_of_take(Statistic take, std::string const& column_unit) {
  if (take == Statistic::relative_error) return "1";
  return takes_time(take) ? "s" : column_unit;
}

// Keys that only some ways of taking a number have: needed there, refused elsewhere.
bool wants(Section const& section, std::string_view key, bool wanted, std::string const& what) {
  if (!wanted)
    section.refuse(key, "is not used by this \"take\"");
  else if (!section.has(key))
    section.report_missing(key, what, std::string(key) + " = ...");
  return wanted && section.has(key);
}

// The rows that count, or the two times of a change.
void read_rows(Section const& section, QuantitySpec& quantity) {
  bool const one_row = quantity.take == Statistic::at_time || quantity.take == Statistic::initial_value ||
                       quantity.take == Statistic::final_value;
  if (one_row) {
    for (std::string_view const key : {"from", "until"}) section.refuse(key, "is not used by this \"take\"");
    return;
  }
  section.read("from", quantity.from);
  section.read("until", quantity.until);
  check_order(section, {"from", quantity.from}, {"until", quantity.until}, "s");
}

void read_take(Section const& section, std::string const& column_unit, std::map<std::string, double> const& constants,
               QuantitySpec& quantity) {
  bool const threshold = quantity.take == Statistic::first_time_above || quantity.take == Statistic::first_time_below;
  if (wants(section, "threshold", threshold, "the value to pass")) {
    Value const value = *section.find("threshold");
    if (auto const number = read_number(value, column_unit, any_value, section.problems()))
      quantity.threshold = *number;
  }
  if (wants(section, "time", quantity.take == Statistic::at_time, "the time to look at"))
    section.read("time", quantity.time);
  if (wants(section, "reference", compares(quantity.take), "the formula to compare with")) {
    quantity.reference = section.formula("reference", Names{constants, {}, {}});
  }
  read_rows(section, quantity);
}

void read_unit(Section const& section, std::string const& si_unit, QuantitySpec& quantity) {
  quantity.unit = si_unit;
  std::string unit;
  if (!section.read("unit", unit)) return;
  if (same_dimension(unit, si_unit))
    quantity.unit = unit;
  else {
    section.problems().add(section.place_of("unit"), "quantity.unit is " + in_quotes(unit) + " (allowed: a unit of " +
                                                         dimension_noun(si_unit) + " such as " + si_unit + ")");
  }
}

}  // namespace

QuantitySpec read_quantity_section(Section const& section, CaseSpec const& spec,
                                   std::map<std::string, double> const& constants) {
  QuantitySpec quantity;
  read_members(section, quantity_keys(), quantity);
  auto const unit = read_column(section, spec, quantity.column);
  read_take(section, unit.value_or("1"), constants, quantity);
  if (unit) read_unit(section, unit_of_take(quantity.take, *unit), quantity);
  section.refuse_unknown();
  return quantity;
}

}  // namespace piola
