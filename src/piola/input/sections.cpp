// SPDX-License-Identifier: Apache-2.0
#include "piola/input/sections.hpp"
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include <algorithm>
#include <cmath>

namespace piola {

BodyNames const* find_body(Section const& section, std::vector<BodyNames> const& bodies, std::string& name) {
  if (!section.read("body", name)) return nullptr;
  std::vector<std::string> known;
  for (BodyNames const& body : bodies) {
    if (body.name == name) return &body;
    if (!body.name.empty()) known.push_back(body.name);
  }
  section.problems().add(section.place_of("body"), section.name_of("body") + " is " + in_quotes(name) + " (allowed: " +
                                                       joined(known) + ") - " + advice_for_name(name, known));
  return nullptr;
}

std::optional<std::vector<Expression>> read_formulas(Value const& value, std::string_view unit, std::size_t count,
                                                     Names const& names, Problems& problems) {
  return read_formulas(value, unit, {count, count}, names, problems);
}

std::optional<std::vector<Expression>> read_formulas(Value const& value, std::string_view unit,
                                                     std::array<std::size_t, 2> counts, Names const& names,
                                                     Problems& problems) {
  auto const items = read_list(value, counts[0], counts[1], problems);
  if (!items) return std::nullopt;
  std::vector<Expression> formulas;
  for (Value const& item : *items) {
    auto formula = read_formula(item, unit, names, problems);
    formulas.push_back(formula ? std::move(*formula) : Expression());
  }
  return formulas;
}

std::array<std::size_t, 2> directions_of(BodyNames const& body) {
  if (!body.readable) return {1, 3};
  auto const dimension = static_cast<std::size_t>(body.dimension);
  return {dimension, dimension};
}

std::optional<std::array<Expression, 3>> read_vector(Section const& section, std::string_view key,
                                                     BodyNames const& body) {
  auto const value = section.find(key);
  if (!value) return std::nullopt;
  auto formulas = read_formulas(*value, section.info_of(key).unit, directions_of(body), body.names, section.problems());
  if (!formulas) return std::nullopt;
  std::array<Expression, 3> vector;
  std::move(formulas->begin(), formulas->end(), vector.begin());
  return vector;
}

bool read_components(Section const& section, std::string_view key, int dimension, std::array<double, 3>& target) {
  auto const numbers = section.point(key);
  if (!numbers) return false;
  if (static_cast<int>(numbers->size()) != dimension) {
    section.problems().add(section.place_of(key), section.name_of(key) + " has " + std::to_string(numbers->size()) +
                                                      " components (allowed: " + std::to_string(dimension) +
                                                      ", the dimension of the body)");
    return false;
  }
  target = {};
  std::copy(numbers->begin(), numbers->end(), target.begin());
  return true;
}

bool read_direction(Section const& section, std::string_view key, int dimension, std::array<double, 3>& target) {
  std::array<double, 3> direction{};
  if (!read_components(section, key, dimension, direction)) return false;
  double const length = std::hypot(direction[0], direction[1], direction[2]);
  if (!(length > 0)) {
    section.problems().add(section.place_of(key),
                           section.name_of(key) + " is zero (allowed: any other length) - give a direction");
    return false;
  }
  for (std::size_t d = 0; d < 3; ++d) target[d] = direction[d] / length;
  return true;
}

std::array<bool, 3> fixed_axes(Section const& section, std::string const& fix, int dimension) {
  std::string const letters = std::string("xyz").substr(0, static_cast<std::size_t>(dimension));
  std::array<bool, 3> fixed{};
  for (std::size_t d = 0; d < letters.size(); ++d) fixed[d] = fix.find(letters[d]) != std::string::npos;
  if (fix.empty() || fix.size() > 3 || fix.find_first_not_of(letters) != std::string::npos)
    section.problems().add(section.place_of("fix"), section.name_of("fix") + " is " + in_quotes(fix) +
                                                        " (allowed: one or more of the letters " + letters + ")");
  return fixed;
}

std::optional<Section> table_with_keys(Section const& section, std::string_view key, std::string keys) {
  auto const value = section.find(key);
  if (!value) return {};
  if (value->node.is_table()) return Section(value->node, std::move(keys), section.problems());
  section.problems().add(value->node.place, value->name + " is " + shown(value->node) + " (allowed: a table) - write " +
                                                std::string(key) + " = { ... }");
  return {};
}

std::vector<Section> tables_in(Section const& section, std::string_view key, std::size_t most) {
  std::vector<Section> tables;
  auto const value = section.find(key);
  auto const items = value ? read_list(*value, 1, most, section.problems()) : std::nullopt;
  if (!items) return tables;
  for (Value const& item : *items)
    if (item.node.is_table())
      tables.emplace_back(item.node, value->name, section.problems());
    else
      section.problems().add(item.node.place, item.name + " is " + shown(item.node) + " (allowed: a table) - write [[" +
                                                  value->name + "]]");
  return tables;
}

void check_order(Section const& section, std::pair<std::string_view, double> low,
                 std::pair<std::string_view, double> high, std::string_view unit) {
  if (!section.has(high.first) || low.second <= high.second) return;
  section.problems().add(section.place_of(high.first), section.name_of(high.first) + " is " +
                                                           quantity_text(high.second, unit) + " (allowed: at least " +
                                                           section.name_of(low.first) + ", which is " +
                                                           quantity_text(low.second, unit) + ")");
}

Places places_of(Section const& section, std::initializer_list<char const*> keys) {
  Places places{{"", section.place()}};
  for (char const* key : keys)
    if (section.has(key)) places[key] = section.place_of(key);
  return places;
}

}  // namespace piola
