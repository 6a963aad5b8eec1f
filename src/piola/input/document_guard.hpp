// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/problems.hpp"
#include <string>
#include <string_view>

namespace piola {

/// Refuses what the TOML parser could not survive: NUL bytes, files beyond 4 MB, keys so long that the nesting they
/// make would exhaust the stack. Adds to `problems`; never throws.
void refuse_dangerous_text(std::string_view text, std::string const& name, Problems& problems);

}  // namespace piola
