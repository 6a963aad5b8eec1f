// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/input/sections.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

/// Reads [constants]: numbers, quantities, and formulas of other constants in any order.
class ConstantsReader {
 public:
  ConstantsReader(Node const& table, Problems& problems) : table_(table), problems_(problems) {
    for (Node::Entry const& entry : table_.entries)
      if (is_name(entry.key) && !is_reserved_name(entry.key)) usable_.emplace(entry.key, &entry);
  }

  std::map<std::string, double> read() {
    for (Node::Entry const& entry : table_.entries) {
      if (is_name(entry.key) && !is_reserved_name(entry.key)) continue;
      problems_.add(entry.place, in_quotes(entry.key) +
                                     (is_name(entry.key) ? " already has a meaning in formulas" : " is not a name") +
                                     " (allowed: letters, digits and _) - choose another name");
    }
    for (Node::Entry const& entry : table_.entries)
      if (is_name(entry.key) && !is_reserved_name(entry.key)) evaluate(entry);
    return values_;
  }

 private:
  /// The value of a constant, after those that it uses. One that cannot be read is 1, so that formulas that use it do
  /// not complain again.
  void evaluate(Node::Entry const& entry) {
    if (values_.contains(entry.key)) return;
    std::string const name = "constants." + entry.key;
    if (!is_formula(entry.value)) {
      double value = 1;
      if (entry.value.is_text())
        value = of_quantity(entry.value, name);
      else if (auto const number = read_number({entry.value, name}, "", any_value, problems_))
        value = *number;
      values_[entry.key] = value;
      return;
    }
    if (closes_a_ring(entry) || is_too_deep(entry)) return;
    open_.push_back(entry.key);
    for (std::string const& word : expression_words(entry.value.text))
      if (Node::Entry const* used = entry_of(word)) evaluate(*used);
    open_.pop_back();
    if (!values_.contains(entry.key)) values_[entry.key] = of_formula(entry.value, name);
  }

  /// A text that does not begin like a number with a unit.
  static bool is_formula(Node const& node) {
    return node.is_text() && !looks_like_quantity(node.text) && !node.text.empty();
  }

  Node::Entry const* entry_of(std::string const& key) const {
    auto const found = usable_.find(key);
    return found == usable_.end() ? nullptr : found->second;
  }

  /// Whether a constant ends a chain too long for recursion on the stack, far above chains written by hand.
  bool is_too_deep(Node::Entry const& entry) {
    constexpr std::size_t deepest = 200;
    if (open_.size() < deepest) return false;
    problems_.add(entry.value.place, "constants." + entry.key +
                                         " is used by a constant that is used by another, and so "
                                         "on " +
                                         std::to_string(deepest) + " times (allowed: fewer) - use numbers");
    values_[entry.key] = 1;
    return true;
  }

  /// Names for a formula: the constants that it uses; all of them if it uses an unknown one, for the message.
  Names names_for(std::string const& text) const {
    constexpr std::size_t few = 1000;
    Names names;
    for (std::string const& word : expression_words(text))
      if (auto const found = values_.find(word); found != values_.end()) names.constants.insert(*found);
    if (!is_all_known(text) && usable_.size() < few)
      for (auto const& [key, entry] : usable_) names.constants.try_emplace(key, 1);
    return names;
  }

  /// Whether a constant is one of those that are being evaluated; reports the ring, which then has the value 1.
  bool closes_a_ring(Node::Entry const& entry) {
    auto const first = std::find(open_.begin(), open_.end(), entry.key);
    if (first == open_.end()) return false;
    std::string ring;
    for (auto it = first; it != open_.end(); ++it) ring += *it + " -> ";
    problems_.add(entry.value.place, "constants." + entry.key + " depends on itself (" + ring + entry.key +
                                         "; allowed: formulas of other constants) - give one of them a number");
    for (auto it = first; it != open_.end(); ++it) values_[*it] = 1;
    return true;
  }

  double of_quantity(Node const& node, std::string const& name) {
    Quantity const quantity = read_any_quantity(node.text);
    if (!quantity.problem) return quantity.value;
    problems_.add(node.place, name + " cannot be read: " + *quantity.problem);
    return 1;
  }

  double of_formula(Node const& node, std::string const& name) {
    for (std::string const& word : expression_words(node.text)) {
      if (word != "X" && word != "Y" && word != "Z" && word != "t") continue;
      problems_.add(node.place, name + " depends on " + word +
                                    " (allowed: numbers and other constants) - write it where it is used, or "
                                    "as define of the body");
      return 1;
    }
    // A unit may begin with a number: "2 1/s".
    if (Quantity const quantity = read_any_quantity(node.text); !quantity.problem && !is_all_known(node.text))
      return quantity.value;
    auto const formula = read_formula({node, name}, "", names_for(node.text), problems_);
    if (!formula) return 1;
    double const value = (*formula)({});
    if (std::isfinite(value)) return value;
    problems_.add(node.place, name + " is " + number_text(value) +
                                  " (allowed: a finite number) - look for a division "
                                  "by zero or a root of a negative number in " +
                                  in_quotes(node.text));
    return 1;
  }

  /// Whether every name of a formula is a constant or has a meaning in all formulas.
  bool is_all_known(std::string const& text) const {
    auto const words = expression_words(text);
    return std::all_of(words.begin(), words.end(),
                       [&](std::string const& word) { return values_.contains(word) || is_reserved_name(word); });
  }

  Node const& table_;
  Problems& problems_;
  std::map<std::string, double> values_;
  std::map<std::string, Node::Entry const*> usable_;  ///< by name
  std::vector<std::string> open_;  ///< constants that are being evaluated, the first one uses the next
};

}  // namespace

std::map<std::string, double> read_constants(Value const& value, Problems& problems) {
  if (value.node.is_table()) return ConstantsReader(value.node, problems).read();
  problems.add(value.node.place, "constants is " + shown(value.node) + " (allowed: a table) - write [constants]");
  return {};
}

}  // namespace piola
