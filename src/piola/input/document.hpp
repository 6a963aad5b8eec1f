// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/errors.hpp"
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// One value of a case file and its place. Tables keep their entries in the order of the file.
struct Node {
  enum class Kind { table, array, text, integer, real, flag, date };
  struct Entry;

  Kind kind = Kind::table;
  Place place;
  std::string base;            ///< file from whose folder relative paths in the value start; empty: place.file
  std::string text;            ///< text; date: as it is written
  int text_offset = 0;         ///< columns from `place` to the first character of a text; 0 if unknown
  std::string found_at;        ///< text that names a file: where a results folder keeps it; empty: see case_file
  std::int64_t integer = 0;    ///< integer
  double real = 0;             ///< real
  bool flag = false;           ///< flag
  std::vector<Entry> entries;  ///< table
  std::vector<Node> items;     ///< array

  bool is_table() const { return kind == Kind::table; }
  bool is_array() const { return kind == Kind::array; }
  bool is_list_of_tables() const;  ///< not empty, nothing but tables: [[...]]
  bool is_text() const { return kind == Kind::text; }
  bool is_text(std::string_view value) const { return is_text() && text == value; }
  bool is_number() const { return kind == Kind::integer || kind == Kind::real; }
  double number() const { return kind == Kind::integer ? static_cast<double>(integer) : real; }

  /// The entry with this key; null if there is none.
  Node const* find(std::string_view key) const;
  Node* find(std::string_view key);
};

struct Node::Entry {
  std::string key;
  Place place;  ///< of the key
  Node value;
};

/// A text without a place.
Node text_node(std::string_view text);

/// A spelling of the previous minor release that a case uses, as a warning.
struct OldSpelling {
  Place place;
  std::string text;
};

/// A parsed case file, not interpreted yet.
struct Document {
  Node root;
  std::string source;  ///< TOML that reads back as this document: the file itself, or rewritten after changes
  std::vector<OldSpelling> old_spellings = {};  ///< that were replaced (renamed_keys.hpp)
};

/// Parses TOML. Never throws on bad text: errors are added to `problems`, and nothing is returned. Also refuses NUL
/// bytes, more than 4 MB, and keys with more than 64 dots.
std::optional<Document> parse_document(std::string_view text, std::string const& name, Problems& problems);

/// Applies "path=value" settings to a document: a dotted path of keys, with the number or the name of an array's table
/// ("body.0.material.density", "body.column.material.density"), and a TOML value; a value that is no TOML is a text.
/// Places of changed values name the setting; relative paths in them start from the folder of the document
/// (root.place.file). Rewrites `source` if there are any. Document and settings may have spellings of the previous
/// minor release, which become the present ones (renamed_keys.hpp).
void apply_overrides(Document& document, std::span<std::string const> overrides, Problems& problems);

/// TOML text of a table, entries in their order.
std::string toml_text(Node const& root);

/// TOML text of a value, as after "key = ".
std::string toml_value(Node const& node);

}  // namespace piola
