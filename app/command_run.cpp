// SPDX-License-Identifier: Apache-2.0
#include "piola/observers/results_folder.hpp"
#include "commands.hpp"
#include "run_support.hpp"
#include "set_up_watch.hpp"
#include "signals.hpp"
#include <memory>

namespace piola::app {
namespace {

struct RunArguments {
  CaseOptions from;
  std::string out, wall_time;
  bool force = false, quiet = false, no_pictures = false;
};

int run(RunArguments const& options) {
  catch_checkpoint_signals();
  double const wall_time = read_wall_time(options.wall_time);
  auto const file = case_file(options.from.file);
  std::filesystem::path const folder = options.out.empty() ? default_results(file) : std::filesystem::path(options.out);
  Simulation simulation = set_up({.file = file,
                                  .overrides = options.from.overrides(),
                                  .unfinished = folder_for_unfinished(folder),
                                  .pictures = !options.no_pictures},
                                 {.wall_time = wall_time, .quiet = options.quiet});
  RunOptions const where{
      .folder = folder, .resume = false, .force = options.force, .case_file = file, .wall_time = wall_time};
  return run_and_report(simulation, where, options.quiet);
}

}  // namespace

void add_run(CLI::App& program, Action& action) {
  auto const options = std::make_shared<RunArguments>();
  CLI::App* command =
      program.add_subcommand("run", "Run a case: frames, history, pictures and checkpoints go to a results folder");
  options->from.add_to(*command);
  command->add_option("--out,-o", options->out, "Folder for the results (default: NAME-results in this folder)");
  command->add_flag("--force", options->force, "Use the folder even if it holds other things");
  add_wall_time(*command, options->wall_time);
  command->add_flag("--no-pictures", options->no_pictures, "Draw no pictures");
  command->add_flag("--quiet,-q", options->quiet, "Say nothing unless something is wrong");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace piola::app
