// SPDX-License-Identifier: Apache-2.0
#include "piola/study/study.hpp"
#include "commands.hpp"
#include "study_runs.hpp"
#include <memory>

namespace piola::app {
namespace {

struct StudyArguments {
  std::string file, out;
  std::vector<std::string> set;
  int jobs = 0, threads = 0;
};

int study(StudyArguments const& options) {
  namespace fs = std::filesystem;
  StudySpec spec = read_study(options.file);
  if (options.jobs > 0) spec.jobs = options.jobs;
  if (options.threads > 0) spec.threads = options.threads;
  if (spec.threads == 0) spec.threads = share_of_cores(spec.jobs);
  spec.settings = options.set;
  fs::path folder = options.out.empty() ? spec.out : fs::path(options.out);
  if (folder.empty()) folder = fs::path(options.file).stem().string() + "-study";
  auto const runs = combinations(spec);
  auto const identities = identities_of(spec, runs);
  return code_of(make_runs(spec, folder, runs, identities));
}

}  // namespace

void add_study(CLI::App& program, Action& action) {
  auto const options = std::make_shared<StudyArguments>();
  CLI::App* command = program.add_subcommand("study", "Run a case with every combination of some values");
  command->add_option("file", options->file, "The study: case = \"...\" and [parameters] with lists of values")
      ->required();
  command->add_option("--set", options->set, "Change a value of the case in all runs: key=value; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false);
  command->add_option("--out,-o", options->out, "Folder for the runs and study.csv (default: NAME-study)");
  command->add_option("--jobs", options->jobs, "Runs at a time (default 2)")->check(CLI::Range(1, 1024));
  command->add_option("--threads", options->threads, "Threads of each run (default: the cores divided by the jobs)")
      ->check(CLI::Range(1, 1024));
  command->callback([options, &action] { action = [options] { return study(*options); }; });
}

}  // namespace piola::app
