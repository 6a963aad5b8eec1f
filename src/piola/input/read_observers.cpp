// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/formulations/quantity_names.hpp"
#include "piola/formulations/registry.hpp"
#include "piola/input/contact_capabilities.hpp"
#include "piola/input/history_names.hpp"
#include "piola/input/probe_quantities.hpp"
#include "piola/input/sections.hpp"
#include <algorithm>
#include <array>

namespace piola {
namespace {

constexpr std::array contact_columns{std::pair{"contact_energy", "J"}, std::pair{"contact_overlap", "1"},
                                     std::pair{"contact_points", "1"}, std::pair{"friction_heat", "J"},
                                     std::pair{"chatter_damping_loss", "J"}};

using Kind = ProbeSpec::Kind;
using Statistic = QuantitySpec::Statistic;

void read_point(Section const& section, int dimension, ProbeSpec& probe) {
  if (!section.has("at"))
    section.report_missing("at", "the point of the probe", "at = [\"0 m\", ...]");
  else if (auto const at = read_components(section, "at", dimension))
    probe.at = *at;
}

void read_distance(Section const& section, std::string_view key, double& target) {
  if (!section.has(key))
    section.report_missing(key, "a distance from the crack tip", std::string(key) + " = \"1 mm\"");
  else
    section.read(key, target);
}

// Reads the range ahead of a crack tip that the kind "stress_intensity" evaluates.
void read_ahead(Section const& section, int dimension, ProbeSpec& probe) {
  if (probe.kind != Kind::stress_intensity) {
    for (std::string_view const key : {"direction", "from", "to"})
      section.refuse(key, "is used only by the kind \"stress_intensity\"");
    return;
  }
  if (dimension != 2) {
    section.problems().add(section.place_of("kind"), "probe.kind is \"stress_intensity\" for a body in " +
                                                         std::to_string(dimension) +
                                                         "D (allowed in 2D) - choose another kind");
    return;
  }
  if (auto const direction = read_direction(section, "direction", dimension)) probe.direction = *direction;
  read_distance(section, "from", probe.from);
  read_distance(section, "to", probe.to);
  if (section.has("from") && section.has("to") && probe.from > probe.to)
    section.problems().add(section.place_of("to"), "probe.to is " + quantity_text(probe.to, "m") +
                                                       " (allowed: at least probe.from, which is " +
                                                       quantity_text(probe.from, "m") + ")");
}

void read_quantities(Section const& section, ProbeSpec& probe) {
  std::vector<std::string> known;
  for (FieldQuantity const& quantity : all_quantities()) known.push_back(quantity.name);
  auto const own = own_quantities(probe.kind);
  if (!own.empty()) known.clear();
  for (HistoryName const& quantity : own) known.emplace_back(quantity.name);
  auto const value = section.find("quantities");
  if (!value) {
    if (!own.empty())
      probe.quantities = known;
    else
      section.report_missing("quantities", "what to record, for example velocity_x or pressure",
                             "quantities = [\"pressure\"]");
    return;
  }
  auto const items = read_list(*value, 1, 100, section.problems());
  if (!items) return;
  for (Value const& item : *items) {
    if (auto const quantity = read_word(item, known, section.problems())) probe.quantities.push_back(*quantity);
  }
}

// The field and the formulas that the kind "error" compares.
void read_comparison(Section const& section, Names const& names, ProbeSpec& probe) {
  if (probe.kind != Kind::error) {
    section.refuse("field", "is used only by the kind \"error\"");
    section.refuse("reference", "is used only by the kind \"error\"");
    return;
  }
  if (!section.has("field")) section.report_missing("field", "the field to compare", "field = \"CauchyStress\"");
  if (!section.has("reference"))
    section.report_missing("reference", "one formula per component of the field", "reference = [\"0\", ...]");
  std::vector<std::string> known;
  for (FieldName const& field : field_names()) known.emplace_back(field.name);
  auto const value = section.find("field");
  auto const word = value ? read_word(*value, known, section.problems()) : std::nullopt;
  auto const reference = section.find("reference");
  if (!word || !reference) return;
  probe.field = *word;
  auto const& field = *std::find_if(field_names().begin(), field_names().end(),
                                    [&](FieldName const& candidate) { return candidate.name == *word; });
  auto formulas =
      read_formulas(*reference, field.unit, static_cast<std::size_t>(field.components), names, section.problems());
  if (formulas) probe.reference = std::move(*formulas);
}

void check_axis(Section const& section, int dimension, ProbeSpec const& probe) {
  bool const twist = probe.kind == Kind::twist;
  bool const bad_twist = twist && (dimension == 1 || (dimension == 2 && probe.axis != 2));
  bool const bad_extent = probe.kind == Kind::extent && probe.axis >= dimension;
  if (!bad_twist && !bad_extent) return;
  section.problems().add(section.place_of("axis"), std::string("probe.axis does not fit a body in ") +
                                                       std::to_string(dimension) + "D (allowed: " +
                                                       (bad_extent       ? dimension == 1 ? "x" : "x, y"
                                                        : dimension == 2 ? "z"
                                                                         : "no twist in 1D") +
                                                       ")");
}

struct Column {
  std::string name, unit;
};

std::vector<Column> columns_of(CaseSpec const& spec) {
  std::vector<Column> columns;
  for (HistoryName const& column : history_names())
    columns.push_back({std::string(column.name), std::string(column.unit)});
  for (FormulationInfo const& formulation : formulations_of(spec)) {
    for (DiagnosticInfo const& column : formulation.diagnostics)
      columns.push_back({std::string(column.name), std::string(column.unit)});
  }
  auto const add_all = [&](std::string const& name, std::span<PartQuantity const> quantities) {
    for (PartQuantity const& q : quantities) columns.push_back({name + "." + std::string(q.word), std::string(q.unit)});
  };
  for (BodySpec const& body : spec.bodies)
    if (spec.bodies.size() > 1) add_all(body.name, body_quantities());
  for (SupportSpec const& support : spec.supports) add_all(support.name, action_quantities());
  for (LoadSpec const& load : spec.loads)
    if (!load.name.empty()) add_all(load.name, action_quantities());
  for (RigidSpec const& rigid : spec.rigids) {
    add_all(rigid.name, action_quantities());
    if (rigid.turns()) add_all(rigid.name, rigid_quantities());
  }
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
  if (quantity.from > quantity.until)
    section.problems().add(section.place_of("until"), "quantity.until is " + quantity_text(quantity.until, "s") +
                                                          " (allowed: at least quantity.from, which is " +
                                                          quantity_text(quantity.from, "s") + ")");
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

ProbeSpec read_probe(Section const& section, std::vector<BodyNames> const& bodies) {
  ProbeSpec probe;
  section.read("name", probe.name);
  BodyNames const* const body = find_body(section, bodies, probe.body);
  int const dimension = body != nullptr ? body->dimension : 3;
  if (int const kind = section.word_index("kind"); kind >= 0) probe.kind = static_cast<Kind>(kind);
  if (int const axis = section.word_index("axis"); axis >= 0) probe.axis = axis;
  bool const along = probe.kind == Kind::twist || probe.kind == Kind::extent;
  if (probe.kind == Kind::point || probe.kind == Kind::stress_intensity) {
    if (body != nullptr) read_point(section, dimension, probe);
    section.refuse("where", "is not used by the kinds \"point\" and \"stress_intensity\"");
  } else if (!is_cluster_probe(probe.kind)) {
    section.refuse("at",
                   "is used only by the kinds \"point\", \"stress_intensity\", \"fragment\", \"rim\" and \"hole\"");
    probe.where = section.formula("where", body != nullptr ? body->names : Names{});
  }
  read_cluster_probe(section, body, probe);
  read_comparison(section, body != nullptr ? body->names : Names{}, probe);
  read_ahead(section, body != nullptr ? dimension : 2, probe);
  if (along && body != nullptr) check_axis(section, dimension, probe);
  if (!along && !is_cluster_probe(probe.kind))
    section.refuse("axis", "is used only by the kinds \"twist\", \"extent\", \"fragment\", \"rim\" and \"hole\"");
  read_quantities(section, probe);
  section.refuse_unknown();
  probe.places =
      places_of(section, {"where", "at", "body", "name", "reference", "from", "anchored_where", "quantities"});
  return probe;
}

QuantitySpec read_quantity_section(Section const& section, CaseSpec const& spec,
                                   std::map<std::string, double> const& constants) {
  QuantitySpec quantity;
  section.read("name", quantity.name);
  auto const unit = read_column(section, spec, quantity.column);
  if (int const take = section.word_index("take"); take >= 0)
    quantity.take =
        take > static_cast<int>(Statistic::mean) ? Statistic::final_value : static_cast<Statistic>(take);  // "final"
  read_take(section, unit.value_or("1"), constants, quantity);
  if (unit) read_unit(section, unit_of_take(quantity.take, *unit), quantity);
  section.refuse_unknown();
  return quantity;
}

}  // namespace piola
