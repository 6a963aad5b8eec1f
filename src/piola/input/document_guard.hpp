// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/problems.hpp"
#include "piola/input/document.hpp"
#include <cstddef>
#include <string>
#include <string_view>

namespace piola {

/// Bytes of a case file at most; no more need be read of a file to refuse it.
inline constexpr std::size_t most_case_bytes = 4'000'000;

/// Refuses what the TOML parser could not survive: NUL bytes, files beyond 4 MB, keys so long that the nesting they
/// make would exhaust the stack. Adds to `problems`; never throws.
void refuse_dangerous_text(std::string_view text, std::string const& name, Problems& problems);

/// Refuses texts of more than 10 000 characters and keys of more than 200 before anybody computes with them or shows
/// them. Adds to `problems`.
void refuse_long_texts(Node const& node, Problems& problems);

}  // namespace piola
