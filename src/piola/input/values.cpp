// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/input/section.hpp"
#include "piola/input/synonyms.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string expected_number(std::string_view unit) {
  if (unit.empty() || unit == "1") return "(allowed: a number)";
  return "(allowed: a number in " + std::string(unit) + " or a text such as \"2 " + std::string(unit) + "\")";
}

void complain(Value const& value, std::string const& what, Problems& problems) {
  problems.add(value.node.place, value.name + " " + what);
}

// Place of an error inside a text that is literal in the file.
Place place_in_text(Node const& node, int column) {
  Place place = node.place;
  if (column > 0 && node.text_offset > 0 && place.column > 0) place.column += node.text_offset + column - 1;
  return place;
}

std::optional<double> allowed_number(Value const& value, double number, std::string_view unit, Interval const& allowed,
                                     Problems& problems) {
  std::string const suffix = unit.empty() || unit == "1" ? "" : " " + std::string(unit);
  if (!std::isfinite(number)) {
    complain(value, "is " + number_text(number) + " (allowed: a finite number)", problems);
    return std::nullopt;
  }
  if (allowed.contains(number)) return number;
  complain(value, "is " + number_text(number) + suffix + " (allowed: " + interval_text(allowed) + ")", problems);
  return std::nullopt;
}

std::optional<Expression> quantity_formula(Value const& value, std::string_view unit, Problems& problems) {
  Quantity const quantity = read_quantity(value.node.text, unit);
  if (!quantity.problem) return Expression(exact_text(quantity.value));
  complain(value, "cannot be read: " + *quantity.problem, problems);
  return std::nullopt;
}

}  // namespace

std::string shown(Node const& node) {
  switch (node.kind) {
    case Node::Kind::text: return "the text " + in_quotes(node.text);
    case Node::Kind::integer: return std::to_string(node.integer);
    case Node::Kind::real: return number_text(node.real);
    case Node::Kind::flag: return node.flag ? "true" : "false";
    case Node::Kind::date: return "the date " + node.text;
    case Node::Kind::array: return "a list of " + std::to_string(node.items.size());
    case Node::Kind::table: return "a table";
  }
  return "";
}

bool looks_like_quantity(std::string_view text) {
  std::size_t i = 0;
  auto const skip = [&](auto const& matches) {
    std::size_t const start = i;
    while (i < text.size() && matches(text[i])) ++i;
    return i > start;
  };
  skip([](char c) { return c == ' '; });
  if (i < text.size() && (text[i] == '+' || text[i] == '-')) ++i;
  bool number = skip(is_digit);
  if (i < text.size() && text[i] == '.') ++i;
  number = skip(is_digit) || number;
  if (!number) return false;
  bool const exponent = i + 1 < text.size() && (text[i] == 'e' || text[i] == 'E');
  std::size_t const digits = i + (exponent && (text[i + 1] == '+' || text[i + 1] == '-') ? 2 : 1);
  if (exponent && digits < text.size() && is_digit(text[digits])) {
    i = digits;
    skip(is_digit);
  }
  skip([](char c) { return c == ' '; });
  if (i >= text.size()) return false;
  char const c = text[i];
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%' || static_cast<unsigned char>(c) >= 0x80;
}

std::optional<double> read_number(Value const& value, std::string_view unit, Interval const& allowed,
                                  Problems& problems) {
  if (value.node.is_number()) return allowed_number(value, value.node.number(), unit, allowed, problems);
  if (!value.node.is_text()) {
    complain(value, "is " + shown(value.node) + " " + expected_number(unit), problems);
    return std::nullopt;
  }
  Quantity const quantity = read_quantity(value.node.text, unit.empty() ? "1" : unit);
  if (quantity.problem) {
    complain(value, "cannot be read: " + *quantity.problem, problems);
    return std::nullopt;
  }
  return allowed_number(value, quantity.value, unit, allowed, problems);
}

std::optional<std::int64_t> read_whole(Value const& value, Interval const& allowed, Problems& problems) {
  bool const whole = value.node.kind == Node::Kind::integer;
  if (whole && allowed.contains(value.node.number())) return value.node.integer;
  complain(value, "is " + shown(value.node) + " (allowed: a whole number " + interval_text(allowed) + ")", problems);
  return std::nullopt;
}

std::optional<std::string> read_text(Value const& value, Problems& problems) {
  if (value.node.is_text()) return value.node.text;
  complain(value, "is " + shown(value.node) + " (allowed: a text in quotes)", problems);
  return std::nullopt;
}

std::optional<std::string> read_word(Value const& value, std::vector<std::string> const& allowed, Problems& problems) {
  auto text = read_text(value, problems);
  if (!text) return std::nullopt;
  if (std::find(allowed.begin(), allowed.end(), *text) != allowed.end()) return text;
  auto const synonym = advice_for_synonym(*text, allowed);
  bool const by_meaning = !synonym.empty() && !synonym.starts_with("that is");
  complain(value,
           "is " + in_quotes(*text) + " (allowed: " + known_names_text(*text, allowed) + ") - " +
               (by_meaning ? synonym : advice_for_name(*text, allowed)),
           problems);
  return std::nullopt;
}

std::optional<Expression> read_formula(Value const& value, std::string_view unit, Names const& names,
                                       Problems& problems) {
  if (value.node.is_number()) {
    auto const number = allowed_number(value, value.node.number(), unit, any_value, problems);
    if (!number) return std::nullopt;
    return Expression(exact_text(*number));
  }
  if (value.node.is_table() && !unit.empty()) return read_table(value, unit, names, problems);
  if (!value.node.is_text()) {
    complain(value, "is " + shown(value.node) + " (allowed: a formula in quotes, or a number)", problems);
    return std::nullopt;
  }
  if (!unit.empty() && looks_like_quantity(value.node.text)) return quantity_formula(value, unit, problems);
  try {
    return Expression(value.node.text, names);
  } catch (ExpressionError const& error) {
    problems.add(place_in_text(value.node, error.column),
                 value.name + ", formula " + in_quotes(value.node.text) + ": " + error.text);
    return std::nullopt;
  }
}

std::optional<std::vector<Value>> read_list(Value const& value, std::size_t least, std::size_t most,
                                            Problems& problems) {
  PIOLA_EXPECTS(least <= most);
  std::size_t const size = value.node.items.size();
  if (!value.node.is_array() || size < least || size > most) {
    std::string const length = least == most ? std::to_string(least)
                               : most > 100  ? std::to_string(least) + " or more"
                                             : std::to_string(least) + " to " + std::to_string(most);
    complain(value, "is " + shown(value.node) + " (allowed: a list of " + length + ")", problems);
    return std::nullopt;
  }
  std::vector<Value> items;
  for (std::size_t i = 0; i < size; ++i) {
    items.push_back({value.node.items[i], value.name + "[" + std::to_string(i) + "]"});
  }
  return items;
}

}  // namespace piola
