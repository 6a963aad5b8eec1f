// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/simulation/run_case.hpp"
#include <CLI/CLI.hpp>
#include <chrono>
#include <string>
#include <system_error>

namespace piola::app {

/// A line on stderr that is renewed on a terminal; elsewhere a new one about every ten seconds.
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

/// Shows progress by a status line. Warnings always.
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

/// When the program was started.
extern WallLimit::Clock::time_point const program_start;

/// What is about to run, in a few lines.
std::string start_report(Simulation const& simulation, std::filesystem::path const& folder);
/// What came out.
std::string end_report(CaseOutcome const& outcome, std::filesystem::path const& folder);

/// --wall-time, and what it says [s]: a time such as "2 h", without a unit in seconds; nothing if it is not given.
/// Throws InputError for anything else.
void add_wall_time(CLI::App& command, std::string& text);
double read_wall_time(std::string const& text);

/// Runs a prepared simulation with reports, progress and signals; the wall time counts from the start of the program.
/// Returns the exit code.
int run_and_report(Simulation& simulation, RunOptions options, bool quiet);

/// Throws InputError if an error says that the links at a path lead in a circle.
void refuse_link_loop(std::filesystem::path const& path, std::error_code const& error);

/// case.toml itself, or the one in a folder. Throws InputError if there is none.
std::filesystem::path case_file(std::filesystem::path const& given);

}  // namespace piola::app
