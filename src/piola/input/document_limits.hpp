// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/errors.hpp"
#include "piola/input/document.hpp"
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace piola {

/// Largest size of a case file [bytes]; at most this is read before a file is refused.
inline constexpr std::size_t most_case_bytes = 4'000'000;

/// Refuses what the TOML parser could not survive: NUL bytes, files beyond 4 MB, keys and brackets whose nesting would
/// exhaust the stack. Time: linear in the text. Adds to `problems`; never throws.
void refuse_dangerous_text(std::string_view text, std::string const& name, Problems& problems);

/// Where a quoted text begins that does not end: on its line, or in the file if three quotes begin it.
std::optional<Place> find_open_quote(std::string_view text, std::string const& name);

/// Refuses texts of more than 10 000 characters, keys of more than 200, and control characters in both, before they are
/// used or displayed. Adds to `problems`.
void refuse_unusable_texts(Node const& node, Problems& problems);

}  // namespace piola
