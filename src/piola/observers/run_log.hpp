// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/observers/time_state.hpp"
#include "piola/output/atomic_file.hpp"
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace piola {

/// Data of a progress line.
struct Progress {
  TimeState moment;
  double end = 0;                ///< s
  double total_energy = 0;       ///< J, at the last row of the history
  double stages_per_second = 0;  ///< particle-stages per second of the steps
  double seconds_left = 0;       ///< estimated wall time
};

/// Receives the messages of a run; the program decides what is shown. Library code never prints.
class Listener {
 public:
  virtual ~Listener() = default;
  virtual void progress(Progress const&) {}
  virtual void warning(std::string const&) {}
};

/// log.txt of a results folder (start, warnings, bounds of shorter steps, outcome), and the list of warnings of the
/// run.
class RunLog {
 public:
  /// With an empty path warnings are stored and passed on, and nothing is written.
  RunLog(std::filesystem::path file, Listener& listener) : file_(std::move(file)), listener_(listener) {}
  /// Creates or truncates the file. Throws FileError.
  void start(std::string const& first_line);
  void note(std::string const& line);
  /// Logs a warning and passes it to the listener; repeated texts only once.
  void warn(std::string const& text);
  /// Logs a preliminary warning and passes it to the listener. Not added to warnings(); its final form is, at the end
  /// of the run.
  void report(std::string const& text);
  std::vector<std::string> const& warnings() const { return warnings_; }

 private:
  void write(std::string const& line, Opening how);
  std::filesystem::path file_;
  bool begun_ = false;  ///< something was written
  Listener& listener_;
  std::vector<std::string> warnings_;
  std::set<std::string> known_;
};

}  // namespace piola
