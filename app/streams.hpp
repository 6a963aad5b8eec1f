// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace piola::app {

/// Call first in main. Opens closed descriptors 0 to 2 as /dev/null, so that no file of a run gets their number and
/// messages as content; writing to such a standard output or error still fails. A closed pipe (SIGPIPE) and a file size
/// limit (SIGXFSZ) become ordinary write errors.
void secure_streams();

/// Switches output off or on: of the ranks of a run only the first one prints.
void set_quiet(bool quiet);

/// Writes to standard output, and to standard error; control characters (base/controls.hpp) are escaped. Neither throws
/// nor ends the program, so that a run continues without a reader.
void write_out(std::string_view text);
void write_err(std::string_view text);

/// Clears the terminal of the standard output.
void clear_terminal();

template <class... T>
void print_result(fmt::format_string<T...> format, T&&... values) {
  write_out(fmt::format(format, std::forward<T>(values)...));
}
template <class... T>
void print_message(fmt::format_string<T...> format, T&&... values) {
  write_err(fmt::format(format, std::forward<T>(values)...));
}

/// The exit code of a command whose result is its standard output: `code`, or internal_error in place of success if not
/// all of it could be written; then the reason goes to standard error, unless the pipe was closed.
int with_output(int code);

}  // namespace piola::app
