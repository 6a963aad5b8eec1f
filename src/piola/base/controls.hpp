// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

namespace piola {

/// Position of the first control character of a UTF-8 text; npos if there is none. Control characters are U+0000 to
/// U+001F but tab and line feed, a carriage return before a line feed, and U+007F to U+009F: terminals execute them.
std::size_t find_control(std::string_view text);

/// The text with its control characters written as "\x1b". Carriage returns at its start and end, with which a line of
/// a terminal is renewed, are kept.
std::string without_controls(std::string_view text);

}  // namespace piola
