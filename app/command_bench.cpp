// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/bench/bench.hpp"
#include "piola/bench/bench_accuracy.hpp"
#include "commands.hpp"
#include "run_support.hpp"
#include "streams.hpp"
#include <memory>

namespace piola::app {
namespace {

struct BenchArguments {
  BenchOptions options;
  std::vector<std::string> names{"jst_sph"}, parts;
  bool json = false, quick = false;
};

template <class Rows>
int print(Rows const& rows, bool json) {
  write_out(json ? to_json(rows) : to_text(rows));
  return with_output(completed);
}

int bench_accuracy(BenchArguments const& arguments) {
  AccuracyOptions accuracy;
  accuracy.cases = data_folder("cases", "cases");
  accuracy.backend = arguments.options.backend;
  if (arguments.quick) accuracy.across = {3, 5};
  return print(measure_accuracy(accuracy), arguments.json);
}

int bench(BenchArguments const& arguments) {
  if (arguments.parts == std::vector<std::string>{"accuracy"}) return bench_accuracy(arguments);
  BenchOptions options = arguments.options;
  if (options.cases.empty()) options.cases = data_folder("bench", "bench/cases");
  if (arguments.parts.empty()) options.names = arguments.names;
  for (std::string const& name : arguments.names)
    for (std::string const& part : arguments.parts) options.names.push_back(name + "/" + part);
  if (arguments.quick) {
    options.repeats = 3;
    options.most_per_side = 24;
  }
  return print(measure_steps(options), arguments.json);
}

}  // namespace

void add_bench(CLI::App& program, Action& action) {
  auto const arguments = std::make_shared<BenchArguments>();
  BenchOptions& options = arguments->options;
  CLI::App* command = program.add_subcommand("bench", "Measure the speed of the solver on this computer");
  command->add_option("names", arguments->names,
                      "Benchmarks to measure: jst_sph (default), nodal, taylor_sph, adaptle, contact, or one of a "
                      "folder such as nodal/rates");
  command
      ->add_option("--only", arguments->parts,
                   "Parts of these to measure, such as rates. Or accuracy: errors of nodal and jst_sph against "
                   "processor time, some minutes")
      ->type_size(1)
      ->allow_extra_args();
  command->add_flag("--json", arguments->json, "Print one JSON document");
  command->add_flag("--quick", arguments->quick, "Fewer particles (--side 24) and three measurements");
  command
      ->add_option("--side", options.most_per_side,
                   "Particles per side of a cube: larger spacings for cases with more particles")
      ->check(CLI::Range(8, 512));
  command->add_option("--repeats", options.repeats, "Measurements of a step, the fastest counts (default 8)")
      ->check(CLI::Range(1, 1000));
  command->add_option("--threads", options.threads, "Numbers of threads (default 1 2)")->check(CLI::Range(1, 1024));
  add_instruction_set(*command, options.backend, "Instruction set beside the scalar path (default auto)");
  command->add_option("--cases", options.cases, "Folder of the benchmarks (default: those that came with the program)");
  command->callback([arguments, &action] { action = [arguments] { return bench(*arguments); }; });
}

}  // namespace piola::app
