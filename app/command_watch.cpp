// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/renamed_outputs.hpp"
#include "piola/report/watch.hpp"
#include "commands.hpp"
#include "signals.hpp"
#include "streams.hpp"
#include <memory>
#include <sys/ioctl.h>
#include <unistd.h>

namespace piola::app {
namespace {

struct WatchArguments {
  std::string folder, column = "kinetic_energy";
  double every = 2;
  bool once = false;
};

std::size_t width_of_terminal() {
  winsize size{};
  bool const known = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

/// On a terminal the lines are renewed in place; elsewhere each look follows the one before.
int watch(WatchArguments const& options) {
  catch_stop_signals();
  bool const terminal = ::isatty(STDOUT_FILENO) != 0;
  report::Watch run(options.folder, current_output_name(options.column));
  for (;;) {
    auto const [text, over] = run.look(width_of_terminal());
    if (terminal && !options.once) clear_terminal();
    write_out(text);
    if (over || options.once) return with_output(completed);
    if (!wait_unless_stopped(options.every)) return completed;  // the user may stop watching
  }
}

}  // namespace

void add_watch(CLI::App& program, Action& action) {
  auto const options = std::make_shared<WatchArguments>();
  CLI::App* command = program.add_subcommand(
      "watch", "Show how a run stands, in the terminal, until it ends: energies, a column over time, the last row");
  command->add_option("folder", options->folder, "The results folder of the run")->required();
  command->add_option("column", options->column, "The column of history.csv to draw")->capture_default_str();
  command->add_option("--every", options->every, "Seconds between two updates")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  command->add_flag("--once", options->once, "Show one update");
  command->callback([options, &action] { action = [options] { return watch(*options); }; });
}

}  // namespace piola::app
