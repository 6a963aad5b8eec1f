// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/observers/results_folder.hpp"
#include "commands.hpp"
#include "run_support.hpp"
#include "set_up_watch.hpp"
#include "signals.hpp"
#include <fmt/format.h>
#include <memory>

namespace piola::app {
namespace {

struct ResumeArguments {
  CaseOptions from;
  std::string folder, wall_time;
  bool quiet = false;
};

int resume(ResumeArguments const& options) {
  catch_checkpoint_signals();
  double const wall_time = read_wall_time(options.wall_time);
  std::filesystem::path const file = std::filesystem::path(options.folder) / "case.toml";
  std::error_code unusable;
  if (!std::filesystem::exists(file, unusable)) {
    refuse_link_loop(options.folder, unusable);
    throw InputError(fmt::format(
        "{}: holds no case.toml (the folder of an earlier run is needed) - give the folder that 'piola run' wrote to",
        options.folder));
  }
  Simulation simulation = set_up({.file = file,
                                  .overrides = options.from.overrides(),
                                  .unfinished = folder_for_unfinished(options.folder),
                                  .of_results = true},
                                 {.wall_time = wall_time, .quiet = options.quiet});
  return run_and_report(simulation, {.folder = options.folder, .resume = true, .force = false, .wall_time = wall_time},
                        options.quiet);
}

}  // namespace

void add_resume(CLI::App& program, Action& action) {
  auto const options = std::make_shared<ResumeArguments>();
  CLI::App* command = program.add_subcommand("resume", "Continue a run from its newest checkpoint, bit for bit");
  command->add_option("folder", options->folder, "The results folder of the run")->required();
  options->from.add_to(*command, false);
  add_wall_time(*command, options->wall_time);
  command->add_flag("--quiet,-q", options->quiet, "Say nothing unless something is wrong");
  command->callback([options, &action] { action = [options] { return resume(*options); }; });
}

}  // namespace piola::app
