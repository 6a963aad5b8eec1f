// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/simulation/run_case.hpp"
#include <CLI/CLI.hpp>
#include <chrono>
#include <string>
#include <system_error>

namespace piola::app {

/// A status line on stderr: replaced in place on a terminal; elsewhere a new line about every ten seconds.
class StatusLine {
 public:
  StatusLine();
  ~StatusLine();
  StatusLine(StatusLine const&) = delete;
  StatusLine& operator=(StatusLine const&) = delete;
  void show(std::string const& line);
  void clear();  ///< removes it before other text

 private:
  bool terminal_;
  std::size_t shown_ = 0;
  std::chrono::steady_clock::time_point last_;
};

/// Shows progress by a status line, and all warnings.
class Console : public Listener {
 public:
  explicit Console(bool quiet) : quiet_(quiet) {}
  void progress(Progress const& progress) override;
  void warning(std::string const& text) override;
  void clear() { line_.clear(); }  ///< removes a progress line before other text

 private:
  bool quiet_;
  StatusLine line_;
};

/// Start time of the program.
extern WallLimit::Clock::time_point const program_start;

/// "in 3D", "axisymmetric"
std::string dimension_text(ParticleSet const& particles);

/// A summary of a run before its start, in a few lines.
std::string start_report(Simulation const& simulation, std::filesystem::path const& folder);
/// The result of a run.
std::string end_report(CaseOutcome const& outcome, std::filesystem::path const& folder);

/// Adds --wall-time, and parses its value [s]: a time such as "2 h", without a unit in seconds; empty if not given.
/// Throws InputError for anything else.
void add_wall_time(CLI::App& command, std::string& text);
double read_wall_time(std::string const& text);

/// Runs a prepared simulation with reports, progress and signals; the wall time counts from the start of the program.
/// Returns the exit code.
int run_and_report(Simulation& simulation, RunOptions options, bool quiet);

/// Throws InputError if an error reports a loop of symbolic links at a path.
void refuse_link_loop(std::filesystem::path const& path, std::error_code const& error);

/// A folder that came with the program: share/piola/NAME where it is installed, or `source` in the tree of its sources.
std::filesystem::path data_folder(std::string const& name, std::string const& source);

/// case.toml itself, or the one in a folder. Throws InputError if there is none.
std::filesystem::path case_file(std::filesystem::path const& given);

}  // namespace piola::app
