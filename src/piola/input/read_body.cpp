// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/input/region_names.hpp"
#include "piola/input/sections.hpp"
#include <algorithm>
#include <set>

namespace piola {
namespace {

/// Puts named formulas into an order in which each uses only those before it; files may have them in any order.
class DefinitionOrder {
 public:
  DefinitionOrder(Node const& table, Problems& problems) : table_(table), problems_(problems) {}

  /// Nothing (and a problem) if some use themselves.
  std::vector<Node::Entry const*> sorted() {
    for (Node::Entry const& entry : table_.entries) visit(entry);
    return circular_ ? std::vector<Node::Entry const*>{} : order_;
  }

 private:
  void visit(Node::Entry const& entry) {
    if (done_.contains(entry.key)) return;
    if (open_.contains(entry.key)) {
      circular_ = true;
      problems_.add(entry.value.place, "body.define." + entry.key +
                                           " uses itself, directly or through others - "
                                           "write it without " +
                                           in_quotes(entry.key));
      return;
    }
    // Chains are followed by recursion; the limit is far above chains written by hand.
    if (open_.size() >= 200) return;
    open_.insert(entry.key);
    if (entry.value.is_text()) {
      for (std::string const& word : expression_words(entry.value.text)) {
        if (Node::Entry const* const used = entry_of(word)) visit(*used);
      }
    }
    open_.erase(entry.key);
    if (done_.insert(entry.key).second) order_.push_back(&entry);
  }

  Node::Entry const* entry_of(std::string_view key) const {
    auto const found = std::find_if(table_.entries.begin(), table_.entries.end(),
                                    [&](Node::Entry const& entry) { return entry.key == key; });
    return found == table_.entries.end() ? nullptr : &*found;
  }

  Node const& table_;
  Problems& problems_;
  std::set<std::string> done_, open_;
  bool circular_ = false;
  std::vector<Node::Entry const*> order_;
};

std::string name_problem(std::string const& name, Names const& names) {
  if (!is_name(name)) return " is not a name";
  if (is_reserved_name(name)) return " already has a meaning in formulas";
  if (names.constants.contains(name)) return " is already a constant";
  if (names.places.contains(name)) return " is already a region";
  return "";
}

// The formula as text; a quantity with a unit becomes its SI number.
std::optional<std::string> definition_text(Value const& value, Names const& names, Problems& problems) {
  if (value.node.is_text() && looks_like_quantity(value.node.text)) {
    Quantity const quantity = read_any_quantity(value.node.text);
    if (!quantity.problem) return exact_text(quantity.value);
    problems.add(value.node.place, value.name + " cannot be read: " + *quantity.problem);
    return std::nullopt;
  }
  auto const formula = read_formula(value, "", names, problems);
  if (!formula) return std::nullopt;
  return formula->text();
}

std::optional<std::array<Expression, 9>> read_gradient(Section const& section, BodyNames const& body) {
  auto const value = section.find("initial_deformation_gradient");
  if (!value) return std::nullopt;
  auto const [least, most] = directions_of(body);
  auto const rows = read_list(*value, least, most, section.problems());
  if (!rows) return std::nullopt;
  std::size_t const count = rows->size();
  std::array<Expression, 9> F;
  for (std::size_t i = 0; i < 3; ++i) F[4 * i] = Expression("1");
  for (std::size_t i = 0; i < count; ++i) {
    auto row = read_formulas((*rows)[i], "1", count, body.names, section.problems());
    if (!row) return std::nullopt;
    for (std::size_t j = 0; j < count; ++j) F[3 * i + j] = std::move((*row)[j]);
  }
  return F;
}

/// Refuses a table over time as a value at the start, where it is the same everywhere.
void refuse_tables_over_time(Section const& section, std::string_view key, std::span<Expression const> formulas) {
  for (Expression const& formula : formulas)
    if (!formula.is_formula() && formula.depends_on_time())
      section.problems().add(section.place_of(key), section.name_of(key) + " is a " + formula.text() +
                                                        " (allowed: over a place, since it is the value at the "
                                                        "start) - add over = \"X\" or another formula of the place");
}

void check_law(Section const& section, BodySpec const& body) {
  auto const formulation = find_formulation(body.formulation.name);
  if (!formulation || body.law.empty()) return;
  bool const of_library = !law_of(body.material).library.empty();
  auto const is_usable = [&](FormulationInfo const& info) {
    auto const& laws = info.laws;
    return of_library ? info.block_laws : std::find(laws.begin(), laws.end(), std::string_view(body.law)) != laws.end();
  };
  if (is_usable(*formulation)) return;
  std::vector<std::string_view> able;
  for (FormulationInfo const& other : formulations())
    if (is_usable(other)) able.push_back(other.name);
  section.problems().add(section.place_of("material"),
                         "the formulation " + in_quotes(body.formulation.name) + " cannot use the law " +
                             in_quotes(body.law) + " (allowed: " + joined(formulation->laws) +
                             ") - change body.material.law or body.formulation (" + joined(able) + " can use it)");
}

/// Places of what a table holds, as "material.density".
void add_places_within(Section const& section, std::string const& table, Places& places) {
  Node const* const node = section.node().find(table);
  if (node == nullptr) return;
  for (Node::Entry const& entry : node->entries) places[table + "." + entry.key] = entry.value.place;
}

}  // namespace

std::vector<Definition> read_definitions(Value const& value, Names const& names, Problems& problems) {
  Names known = names;
  if (!value.node.is_table()) {
    problems.add(value.node.place,
                 value.name + " is " + shown(value.node) + " (allowed: a table such as define = { w = \"2*X\" })");
    return {};
  }
  std::vector<Node::Entry const*> const order = DefinitionOrder(value.node, problems).sorted();
  if (order.empty()) {
    // Known as numbers all the same, so that formulas which use them do not complain again.
    for (Node::Entry const& entry : value.node.entries) known.definitions.push_back({entry.key, "0"});
  }
  for (Node::Entry const* entry : order) {
    if (std::string const problem = name_problem(entry->key, names); !problem.empty()) {
      problems.add(entry->place,
                   in_quotes(entry->key) + problem + " (allowed: letters, digits and _) - choose another name");
      continue;
    }
    auto text = definition_text({entry->value, value.name + "." + entry->key}, known, problems);
    known.definitions.push_back({entry->key, text ? std::move(*text) : "0"});
  }
  return known.definitions;
}

BodySpec read_body(Section const& section, Names const& common, CaseLibrary const& library, BodyNames& names) {
  BodySpec body;
  section.read("name", body.name);
  names.names = common;
  std::size_t const before = section.problems().count();
  if (auto const shape = section.table("shape")) body.shape = read_shape(*shape, names.names);
  bool const usable = section.has("shape") && section.problems().count() == before;
  if (auto const material = section.table("material")) read_material(*material, library, body);
  names.name = body.name;
  names.dimension = body.shape.dimension;
  names.readable = usable;
  names.shape = body.shape;
  if (auto const define = section.find("define")) {
    names.names.definitions = read_definitions(*define, names.names, section.problems());
  }
  add_names_of_places(body.shape, usable, names.names);
  if (auto const formulation = section.table("formulation"))
    body.formulation = read_formulation(*formulation, names.names);
  check_law(section, body);
  if (auto velocity = read_vector(section, "initial_velocity", names)) body.initial_velocity = std::move(*velocity);
  body.initial_displacement = read_vector(section, "initial_displacement", names);
  body.initial_deformation_gradient = read_gradient(section, names);
  if (auto const value = section.find("initial_temperature"))
    body.initial_temperature = read_formula(*value, "K", names.names, section.problems());
  refuse_tables_over_time(section, "initial_velocity", body.initial_velocity);
  if (auto const& u = body.initial_displacement) refuse_tables_over_time(section, "initial_displacement", *u);
  if (auto const& F = body.initial_deformation_gradient)
    refuse_tables_over_time(section, "initial_deformation_gradient", *F);
  if (auto const& T = body.initial_temperature) refuse_tables_over_time(section, "initial_temperature", {&*T, 1});
  section.refuse_unknown();
  body.places.merge(
      places_of(section, {"name", "shape", "material", "formulation", "initial_velocity", "initial_displacement",
                          "initial_deformation_gradient", "initial_temperature"}));
  for (std::string const table : {"material", "formulation"}) add_places_within(section, table, body.places);
  return body;
}

}  // namespace piola
