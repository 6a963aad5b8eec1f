// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/simulation/run_case.hpp"
#include <CLI/CLI.hpp>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>

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

/// For read_case: shows how far a packing is that takes more than two seconds, with the time left.
class PackingLine {
 public:
  explicit PackingLine(bool quiet) : quiet_(quiet) {}
  void operator()(std::string const& body, double share);

 private:
  bool quiet_;
  StatusLine line_;
  std::string body_;
  std::chrono::steady_clock::time_point begun_;
};

/// Says what takes so long, on a terminal, from the third second of its life on. Nobody else may write meanwhile.
class WaitingLine {
 public:
  explicit WaitingLine(std::string what);
  ~WaitingLine();
  WaitingLine(WaitingLine const&) = delete;
  WaitingLine& operator=(WaitingLine const&) = delete;

 private:
  void keep_saying(std::string const& what);

  std::mutex mutex_;
  std::condition_variable over_;
  bool is_over_ = false;
  std::thread thread_;  ///< what is waited for has no time to say it
};

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
