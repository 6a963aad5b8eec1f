// SPDX-License-Identifier: Apache-2.0
#include "piola/base/problems.hpp"
#include "piola/simulation/bench.hpp"
#include "commands.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace piola::app {
namespace {

struct Options {
  std::string formulation = "jst_sph";
  BenchOptions bench;
  std::vector<std::string> parts;
  bool json = false, quick = false;
};

int bench(Options options) {
  if (options.formulation != "jst_sph")
    throw InputError(fmt::format("no benchmark is named '{}' (known: jst_sph)", options.formulation));
  if (options.quick) {
    options.bench.particles_per_side = 24;
    options.bench.repeats = 3;
    options.bench.column_particles = {14, 79, 14};
    options.bench.column_steps = 20;
  }
  auto const wanted = [&](char const* part) {
    return options.parts.empty() || std::find(options.parts.begin(), options.parts.end(), part) != options.parts.end();
  };
  options.bench.rates = wanted("rates");
  options.bench.column = wanted("column");
  options.bench.variables = wanted("variables");
  BenchReport const report = bench_jst_sph(options.bench);
  fmt::print("{}", options.json ? to_json(report) : to_text(report));
  return completed;
}

}  // namespace

void add_bench(CLI::App& program, Action& action) {
  auto const options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("bench", "Measure the speed of the solver on this computer");
  command->add_option("formulation", options->formulation, "What to measure (default: jst_sph)");
  command
      ->add_option("--only", options->parts,
                   "Parts to measure: rates (particle-stages per second), column (simulated time per processor time of "
                   "the twisting column), variables (cost of the filter, of J and of H); default: all")
      ->check(CLI::IsMember({"rates", "column", "variables"}));
  command->add_flag("--json", options->json, "Print one JSON document");
  command->add_flag("--quick", options->quick, "A few seconds only: 24^3 particles, a coarser column");
  command->add_option("--side", options->bench.particles_per_side, "Particles per side of the cube (default 64)")
      ->check(CLI::Range(8, 512));
  command->add_option("--repeats", options->bench.repeats, "Time steps per measurement, the fastest counts (default 8)")
      ->check(CLI::Range(1, 1000));
  command->add_option("--threads", options->bench.threads, "Numbers of threads (default 1 2)")
      ->check(CLI::Range(1, 1024));
  command->add_option("--machine", options->bench.machine, "Instruction set beside the scalar path (default auto)");
  command->callback([options, &action] { action = [options] { return bench(*options); }; });
}

}  // namespace piola::app
