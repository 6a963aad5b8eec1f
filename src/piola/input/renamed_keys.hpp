// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/document.hpp"
#include <optional>
#include <string>
#include <string_view>

namespace piola {

/// Returns the present spelling of a key of a section that had another one in the previous minor release. Empty for
/// any other key. `section` as in KeyInfo.
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
