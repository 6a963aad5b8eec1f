// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/expression.hpp"
#include "piola/base/parameter.hpp"
#include "piola/input/case_keys.hpp"
#include "piola/input/document.hpp"
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// A value of a section: the node and its name in messages, e.g. "run.end".
struct Value {
  Node const& node;
  std::string name;
};

/// Text of a value for messages such as "run.end is true (allowed: ...)".
std::string shown(Node const& node);

/// A number in SI from a number or a text with a unit; an empty unit accepts pure numbers only. Adds to `problems` and
/// returns nothing if it cannot be read, is not finite or not allowed.
std::optional<double> read_number(Value const& value, std::string_view unit, Interval const& allowed,
                                  Problems& problems);
std::optional<std::int64_t> read_whole(Value const& value, Interval const& allowed, Problems& problems);
std::optional<std::string> read_text(Value const& value, Problems& problems);
/// A text that must be one of `allowed`.
std::optional<std::string> read_word(Value const& value, std::vector<std::string> const& allowed, Problems& problems);
/// A formula, a number, or (if a unit is expected) a text with a number and a unit, or a table.
std::optional<Expression> read_formula(Value const& value, std::string_view unit, Names const& names,
                                       Problems& problems);
/// The part of read_formula() for a table such as { table = [[0, 0], ["1 ms", "5 kN"]] } or { file = "force.csv" }.
std::optional<Expression> read_table(Value const& value, std::string_view unit, Names const& names, Problems& problems);
/// The points of a table in SI units, in their order.
struct TablePoints {
  std::vector<double> x, y;
};
/// The rows of a table, its argument increasing: a list of pairs or { file = "curve.csv" }. `units`: of argument and
/// values.
std::optional<TablePoints> read_table_points(Value const& value, std::array<std::string_view, 2> const& units,
                                             Problems& problems);
/// The items of a list whose length is between `least` and `most`; nothing if it is no such list.
std::optional<std::vector<Value>> read_list(Value const& value, std::size_t least, std::size_t most,
                                            Problems& problems);

/// Whether a text starts like a quantity: a number directly followed by a unit ("5 m/s"), not by an operator ("5*X").
bool looks_like_quantity(std::string_view text);

/// Reads a table of the case file. Reports missing, unknown and wrong keys by the table of keys of its section. Every
/// read function leaves the target as it is if the key is missing or wrong.
class Section {
 public:
  /// Precondition: `node` is a table. `section` names the rows of the table of keys.
  Section(Node const& node, std::string section, Problems& problems);

  Node const& node() const { return node_; }
  std::string const& name() const { return section_; }  ///< as in KeyInfo::section
  Place const& place() const { return node_.place; }
  Problems& problems() const { return problems_; }
  bool has(std::string_view key) const { return node_.find(key) != nullptr; }
  /// Place of a value, or of the section if the key is missing.
  Place place_of(std::string_view key) const;

  /// The file from whose folder relative paths in a value start: the case, also for values of settings. Of the section
  /// if the key is missing.
  Place base_of(std::string_view key) const;

  /// The value of a key; a missing required key is a problem.
  std::optional<Value> find(std::string_view key) const;
  /// A sub-table as a section of its own.
  std::optional<Section> table(std::string_view key) const;

  bool read(std::string_view key, double& target) const;       ///< quantity
  bool read(std::string_view key, std::string& target) const;  ///< text, name or word
  bool read(std::string_view key, bool& target) const;         ///< flag
  std::optional<std::int64_t> whole(std::string_view key) const;
  std::optional<Expression> formula(std::string_view key, Names const& names) const;
  /// One number per direction, 1 to 3 of them.
  std::optional<std::vector<double>> point(std::string_view key) const;
  /// Index of a word in the table of keys, whose order is that of the enumerators; -1 if there is none.
  int word_index(std::string_view key) const;
  std::string name_of(std::string_view key) const;
  KeyInfo const& info_of(std::string_view key) const;

  /// Reports the keys that are neither in the table of keys nor in `more`, except those `reported` already.
  void refuse_unknown(std::vector<std::string> const& more = {}, std::vector<std::string> const& reported = {}) const;
  /// Reports a missing required key; `about` and `example` are texts for the message.
  void report_missing(std::string_view key, std::string_view about, std::string_view example) const;
  /// Reports a key that has no meaning here, if it is given.
  void refuse(std::string_view key, std::string const& reason) const;
  /// "OWNER needs one of KINDS (has none) - add one", or how many it has that should have one. `given` is not 1.
  void refuse_count(std::string_view owner, std::ptrdiff_t given, std::string_view kinds) const;

 private:
  Node const& node_;
  std::string section_;
  Problems& problems_;
};

}  // namespace piola
