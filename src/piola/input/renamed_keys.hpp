// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/document.hpp"
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace piola {

/// A key that had another spelling in the previous minor release. `section` as in KeyInfo.
struct RenamedKey {
  std::string_view section, before, now;
};

/// A word of a key that had another spelling in the previous minor release.
struct RenamedWord {
  std::string_view section, key, before, now;
};

/// All of them; columns and fields are in formulations/renamed_outputs.hpp. The next minor release empties these
/// tables.
std::span<RenamedKey const> renamed_keys();
std::span<RenamedWord const> renamed_words();

/// Returns the present spelling of a key of renamed_keys(). Empty for any other key.
std::optional<std::string_view> renamed_key(std::string_view section, std::string_view key);

/// Returns the section of a table: "body.formulation" for the key "formulation" of "body". Lists have the section of
/// their tables, and the material of a part that of a body.
std::string section_below(std::string_view section, std::string_view key);

/// Notes that `before` is now `now` as an old spelling of the document.
void note_old_spelling(Document& document, Place const& place, std::string_view before, std::string_view now);

/// Replaces the spellings of keys, words, columns and fields of the previous minor release by the present ones, notes
/// each in `old_spellings` and rewrites `source` if there are any. A key in both spellings is a problem; the old one is
/// removed.
void use_current_spellings(Document& document, Problems& problems);

}  // namespace piola
