// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

namespace piola {

/// A place in a text file; line and column count from 1, 0 means unknown.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};

/// Collects all errors of the user's input for one message. Grammar of an entry: what is wrong (what is allowed) - what
/// to do.
class Problems {
 public:
  void add(Place const& place, std::string text);
  bool empty() const { return lines_.empty(); }
  std::size_t count() const { return lines_.size(); }
  std::vector<std::string> const& lines() const { return lines_; }  ///< "file:line:column: text", in order of adding
  /// Sorts the lines by position in the file; lines without a position come first.
  void sort_by_place();
  /// Throws InputError with every line if there is any problem.
  void raise_if_any() const;

 private:
  std::vector<std::string> lines_;
  std::vector<Place> places_;
};

/// The user's input cannot be used. what() is the whole message, one problem per line. Exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file or folder cannot be read or written (disk full, no permission). Exit code 1 unless input (2).
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The physics left its admissible range. what() explains particle, place, step, values, likely causes. Exit code 3.
class PhysicsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Exit codes that scripts rely on.
enum ExitCode : int { completed = 0, internal_error = 1, bad_input = 2, physics_failed = 3, stopped_by_signal = 4 };

/// How an error ends the program.
struct ErrorReport {
  int code = 0;  ///< an ExitCode; 0: there is no error
  std::string message;
};
/// The exit code and the message of an exception.
ErrorReport report_of(std::exception_ptr const& error);

}  // namespace piola
