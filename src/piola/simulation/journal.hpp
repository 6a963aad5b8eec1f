// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/files.hpp"
#include "piola/simulation/moment.hpp"
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace piola {

/// What a progress line may show.
struct Progress {
  Moment moment;
  double end = 0;                ///< s
  double total_energy = 0;       ///< J, at the last row of the history
  double stages_per_second = 0;  ///< particle-stages per second of the steps
  double seconds_left = 0;       ///< wall time, estimated
};

/// Where a run reports to; the program decides what is shown. Library code never prints.
class Listener {
 public:
  virtual ~Listener() = default;
  virtual void progress(Progress const&) {}
  virtual void warning(std::string const&) {}
};

/// log.txt of a results folder (start, warnings, outcome), and the list of warnings of the run.
class Journal {
 public:
  /// An empty path: warnings are kept and told, nothing is written.
  Journal(std::filesystem::path file, Listener& listener) : file_(std::move(file)), listener_(listener) {}
  /// Starts the file anew. Throws FileError.
  void start(std::string const& first_line);
  void note(std::string const& line);
  /// Notes a warning and tells the listener; the same text only once.
  void warn(std::string const& text);
  /// Notes and tells the listener what is not final yet: the list of warnings has it when the run is over.
  void tell(std::string const& text);
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
