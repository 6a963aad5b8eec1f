// SPDX-License-Identifier: Apache-2.0
#include "commands.hpp"
#include "python_module.hpp"
#include <memory>

namespace piola::app {
namespace {

struct IdentifyArguments {
  std::string file, out, jobs;
  bool force = false;
};

int identify_parameters(IdentifyArguments const& options) {
  std::vector<std::string> words;
  if (!options.out.empty()) words.push_back("--out=" + options.out);
  if (!options.jobs.empty()) words.push_back("--jobs=" + options.jobs);
  if (options.force) words.emplace_back("--force");
  words.emplace_back("--");
  words.push_back(options.file);
  return continue_in_python("piola_identify", words, "python3, python3-numpy and python3-scipy");
}

}  // namespace

void add_identify(CLI::App& program, Action& action) {
  auto const options = std::make_shared<IdentifyArguments>();
  CLI::App* command =
      program.add_subcommand("identify", "Find parameters of a case, such as of a law, from measured curves");
  command->add_option("file", options->file, "The file with parameters and curves, such as fit.toml")->required();
  command->add_option("--out,-o", options->out, "The folder to write (default: the name of the file)");
  command->add_option("--jobs", options->jobs, "Runs at a time (default: the number of cores)");
  command->add_flag("--force", options->force, "Replace what an earlier identification wrote");
  command->callback([options, &action] { action = [options] { return identify_parameters(*options); }; });
}

}  // namespace piola::app
