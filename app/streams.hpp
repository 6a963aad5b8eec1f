// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace piola::app {

/// First thing in main. Descriptors 0 to 2 that are closed become /dev/null, so that no file of a run ever gets their
/// number and messages as content; what is written to such a standard output or error fails, as it did before. A
/// reader who has left (SIGPIPE) and a file size limit (SIGXFSZ) become ordinary write errors.
void secure_streams();

/// From now on nothing is written, or it is again: of ranks that share a run the first one speaks.
void be_silent(bool silent);

/// Writes to standard output, and to standard error; control characters (base/controls.hpp) are escaped. Neither
/// throws, nor ends the program: a run goes on whether anybody listens or not.
void write_out(std::string_view text);
void write_err(std::string_view text);

/// Empties the terminal that is the standard output.
void clear_terminal();

template <class... T>
void say(fmt::format_string<T...> format, T&&... values) {
  write_out(fmt::format(format, std::forward<T>(values)...));
}
template <class... T>
void tell(fmt::format_string<T...> format, T&&... values) {
  write_err(fmt::format(format, std::forward<T>(values)...));
}

/// The exit code of a command whose result is its standard output: `code`, or internal_error in place of success if
/// not all of it could be written; then standard error says why, unless the reader has left.
int with_output(int code);

}  // namespace piola::app
