// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/simulation/run_case.hpp"
#include <atomic>
#include <chrono>
#include <string>

namespace piola::app {

/// Set by SIGINT and SIGTERM to the number of the signal. Another one two seconds later ends the program at once.
extern std::atomic<int> stop_signal;
void catch_stop_signals();

/// Shows progress on stderr: one line that is renewed on a terminal, otherwise a line about every ten seconds. Warnings
/// always.
class Console : public Listener {
 public:
  explicit Console(bool quiet);
  ~Console() override;
  void progress(Progress const& progress) override;
  void warning(std::string const& text) override;
  void clear();  ///< removes a progress line before other text

 private:
  bool quiet_, terminal_;
  std::size_t shown_ = 0;
  std::chrono::steady_clock::time_point last_;
};

/// What is about to run, in a few lines.
std::string start_report(Simulation const& simulation, std::filesystem::path const& folder);
/// What came out.
std::string end_report(CaseOutcome const& outcome, std::filesystem::path const& folder);

/// Runs a prepared simulation with reports, progress and signals; returns the exit code.
int run_and_report(Simulation& simulation, RunOptions const& options, bool quiet);

/// case.toml itself, or the one in a folder. Throws InputError if there is none.
std::filesystem::path case_file(std::filesystem::path const& given);

}  // namespace piola::app
