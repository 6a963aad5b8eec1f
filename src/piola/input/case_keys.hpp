// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/parameter.hpp"
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// One key of a case file. The reader, its messages, `piola describe case` and the manual all use this one table.
struct KeyInfo {
  enum class Kind { text, name, word, quantity, whole, flag, point, formula, formulas, list, table };

  std::string_view section;  ///< "" for the top of the file, else e.g. "body.shape.box"
  std::string_view key;
  Kind kind;
  std::string_view unit;      ///< SI; quantity, point, formula
  Interval allowed;           ///< quantity, point, whole
  std::string_view standard;  ///< what holds if the key is left out; empty: the key must be given
  std::string_view meaning;
  std::span<std::string_view const> words = {};  ///< word: what may be chosen; other kinds: words in place of a value

  bool required() const { return standard.empty(); }
};

/// A section of a case file: a table, or one of a list of tables.
struct SectionInfo {
  std::string_view name;     ///< as in KeyInfo::section
  std::string_view heading;  ///< as written in a file, e.g. "[[body]]", "shape = { ... }"
  std::string_view about;
};

std::span<KeyInfo const> case_keys();
std::span<SectionInfo const> case_sections();

/// The keys of one section, in the order of the manual.
std::vector<KeyInfo> keys_of(std::string_view section);
KeyInfo const& key_info(std::string_view section, std::string_view key);

/// Describes the allowed form of a value, e.g. 'a number in s or a text such as "2 s"'.
std::string value_text(KeyInfo const& info);

/// Describes an interval, e.g. "above 0", "between -1 and 0.5, ends excluded"; empty if everything is allowed.
std::string interval_text(Interval const& allowed);
/// Setting that makes a condition hold: eos = "polynomial"; empty if it always holds.
std::string condition_text(Condition const& condition);

}  // namespace piola
