// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// Helpers for texts of messages. Pure functions, independent of the locale.

/// The text in double quotes, with control characters and bytes beyond ASCII that are not UTF-8 made harmless.
std::string in_quotes(std::string_view text);

/// "a, b, c".
std::string joined(std::span<std::string const> words, std::string_view separator = ", ");
std::string joined(std::span<std::string_view const> words, std::string_view separator = ", ");

/// Number of insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`.
int edit_distance(std::string_view a, std::string_view b);

/// The known word closest to `wanted`, if it is close enough to be a slip of the pen, else the first that starts with
/// it. Capitals count as small letters.
std::optional<std::string> nearest_name(std::string_view wanted, std::span<std::string const> known);

/// Advice about an unknown word: 'did you mean "x"?' or, if no word is near, 'choose one of these'.
std::string advice_for_name(std::string_view wanted, std::span<std::string const> known);

/// The known words for a message about `wanted`: all of them if they are few, else the nearest ones and how many more.
std::string known_names_text(std::string_view wanted, std::span<std::string const> known);

/// Whether the text is a name: letters, digits and underscores, not starting with a digit, at most 64 characters.
bool is_name(std::string_view text);

/// The text without spaces and tabs at its ends.
std::string_view without_blanks(std::string_view text);

/// Copies of views, for the functions above.
std::vector<std::string> to_strings(std::span<std::string_view const> words);

/// A number for display: `digits` significant digits, no trailing zeros ("0.3", "1.7e+07").
std::string number_text(double value, int digits = 6);

/// The shortest text that reads back as the same double.
std::string exact_text(double value);

/// "216,000".
std::string count_text(std::int64_t count);

/// "17 MPa", "153 us": an SI value with a decimal prefix of its unit where that is usual (Pa, s, m, J, N, W, Hz), else
/// "1100 kg/m^3". A pure number (unit "1") stands alone.
std::string quantity_text(double value, std::string_view si_unit, int digits = 4);

/// A time span of the wall clock: "0.35 s", "12 s", "3 min 05 s", "1 h 02 min", "2 d 03 h".
std::string duration_text(double seconds);

/// "1.2 GB" (powers of ten).
std::string size_text(double bytes);

}  // namespace piola
