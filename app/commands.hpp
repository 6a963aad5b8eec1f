// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/errors.hpp"
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace piola::app {

/// Action of the chosen command; returns the exit code. Errors are thrown and turned into messages and codes by main.
using Action = std::function<int()>;

/// Each adds its command with its options to the program and, when the user chose it, stores its action in `action`.
void add_run(CLI::App& program, Action& action);
void add_resume(CLI::App& program, Action& action);
void add_check(CLI::App& program, Action& action);
void add_describe(CLI::App& program, Action& action);
void add_verify(CLI::App& program, Action& action);
void add_render(CLI::App& program, Action& action);
void add_plot(CLI::App& program, Action& action);
void add_watch(CLI::App& program, Action& action);
void add_report(CLI::App& program, Action& action);
void add_study(CLI::App& program, Action& action);
void add_converge(CLI::App& program, Action& action);
void add_bench(CLI::App& program, Action& action);
void add_import(CLI::App& program, Action& action);
void add_identify(CLI::App& program, Action& action);
void add_test_material(CLI::App& program, Action& action);

/// Adds --instruction-set, and --machine, its name in the previous minor release, which no help shows.
void add_instruction_set(CLI::App& command, std::string& backend, std::string const& about);
/// False for names of the previous release, which are in no group.
bool is_shown(CLI::Option const* option);

/// Common options of several commands: changes of a case on the command line before it is read.
struct CaseOptions {
  std::string file;              ///< the case file
  std::vector<std::string> set;  ///< --set key=value
  std::string threads, backend;  ///< --threads, --instruction-set: short for --set run.threads=... and so on
  void add_to(CLI::App& command, bool with_file = true);
  /// All as "key=value", in the order given; --threads and --instruction-set last.
  std::vector<std::string> overrides() const;
};

}  // namespace piola::app
