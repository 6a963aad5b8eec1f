// SPDX-License-Identifier: Apache-2.0
#include "commands.hpp"

namespace piola::app {

void add_instruction_set(CLI::App& command, std::string& backend, std::string const& about) {
  auto* const option = command.add_option("--instruction-set", backend, about);
  command.add_option("--machine", backend, about)->group("")->excludes(option);
}

bool is_shown(CLI::Option const* option) { return !option->get_group().empty(); }

void CaseOptions::add_to(CLI::App& command, bool with_file) {
  if (with_file) command.add_option("case", file, "The case file, or a folder that holds case.toml")->required();
  command
      .add_option("--set", set,
                  "Change a value of the case: key=value, in quotes if it has a space (--set \"run.end=0.1 s\"); may "
                  "be repeated")
      ->type_size(1)
      ->allow_extra_args(false);
  command.add_option(
      "--threads", threads,
      "Number of threads (default: as the case says, else OMP_NUM_THREADS, SLURM_CPUS_PER_TASK or all cores)");
  add_instruction_set(command, backend, "Instruction set: auto, scalar, v3, v4 (default: as the case says)");
}

std::vector<std::string> CaseOptions::overrides() const {
  std::vector<std::string> all = set;
  if (!threads.empty()) all.push_back("run.threads=" + threads);
  if (!backend.empty()) all.push_back("run.instruction_set=" + backend);
  return all;
}

}  // namespace piola::app
