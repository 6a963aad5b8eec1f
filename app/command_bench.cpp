// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/bench/bench.hpp"
#include "piola/bench/bench_accuracy.hpp"
#include "piola/bench/bench_adaptle.hpp"
#include "piola/bench/bench_contact.hpp"
#include "piola/bench/bench_nodal.hpp"
#include "piola/bench/bench_taylor.hpp"
#include "commands.hpp"
#include "streams.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>

namespace piola::app {
namespace {

struct BenchArguments {
  std::string formulation = "jst_sph", backend = "auto";
  std::vector<std::string> parts;
  std::vector<int> threads{1, 2};
  int side = 0, repeats = 8;  ///< side 0: that of the benchmark
  bool json = false, quick = false;
};

template <class Report>
int print(Report const& report, bool json) {
  write_out(json ? to_json(report) : to_text(report));
  return with_output(completed);
}

bool wanted(BenchArguments const& options, char const* part) {
  return options.parts.empty() || std::find(options.parts.begin(), options.parts.end(), part) != options.parts.end();
}

/// Parts that the benchmark of this formulation does not have.
void refuse_parts_beside(BenchArguments const& options, std::vector<std::string> const& known) {
  for (auto const& part : options.parts)
    if (std::find(known.begin(), known.end(), part) == known.end())
      throw InputError(fmt::format("--only: the benchmark of {} has no part '{}' (known: {}) - give one of these",
                                   options.formulation, part, fmt::join(known, ", ")));
}

int bench_jst(BenchArguments const& options) {
  BenchOptions bench;
  bench.backend = options.backend;
  bench.threads = options.threads;
  bench.repeats = options.quick ? 3 : options.repeats;
  if (options.quick) {
    bench.particles_per_side = 24;
    bench.column_particles = {14, 79, 14};
    bench.column_steps = 20;
  }
  if (options.side > 0) bench.particles_per_side = options.side;
  refuse_parts_beside(options, {"rates", "column", "variables"});
  bench.rates = wanted(options, "rates");
  bench.column = wanted(options, "column");
  bench.variables = wanted(options, "variables");
  return print(bench_jst_sph(bench), options.json);
}

void refuse_parts(BenchArguments const& options) {
  if (options.parts.empty()) return;
  throw InputError(
      fmt::format("--only: the benchmark of {} has one part (only jst_sph and nodal have several) - leave it out",
                  options.formulation));
}

int bench_taylor(BenchArguments const& options) {
  refuse_parts(options);
  TaylorBenchOptions bench;
  bench.backend = options.backend;
  bench.threads = options.threads;
  bench.repeats = options.quick ? 3 : options.repeats;
  if (options.quick) {
    bench.plate_side = 80;
    bench.cube_side = 16;
    bench.bar_particles = 10000;
    bench.steps = 30;
  }
  if (options.side > 0) bench.plate_side = options.side;
  return print(bench_taylor_sph(bench), options.json);
}

int bench_impact(BenchArguments const& options) {
  refuse_parts(options);
  AdaptleBenchOptions bench;
  bench.backend = options.backend;
  bench.threads = options.threads;
  bench.repeats = options.quick ? 3 : options.repeats;
  if (options.quick) bench.cube_side = 20;
  if (options.side > 0) bench.cube_side = options.side;
  return print(bench_adaptle(bench), options.json);
}

int bench_columns(BenchArguments const& options) {
  if (options.parts.size() > 1)
    throw InputError(
        "--only: accuracy compares formulations and stands alone - measure the other parts in a second run");
  AccuracyOptions bench;
  bench.backend = options.backend;
  if (options.quick) bench.across = {3, 5};
  return print(bench_accuracy(bench), options.json);
}

int bench_of_nodal(BenchArguments const& options) {
  refuse_parts_beside(options, {"rates", "set-up"});
  NodalBenchOptions bench;
  bench.backend = options.backend;
  bench.threads = options.threads;
  bench.repeats = options.quick ? 3 : options.repeats;
  if (options.quick) bench.cube_side = 24;
  if (options.side > 0) bench.cube_side = options.side;
  bench.rates = wanted(options, "rates");
  bench.set_up = wanted(options, "set-up");
  return print(bench_nodal(bench), options.json);
}

int bench_of_contact(BenchArguments const& options) {
  refuse_parts(options);
  ContactBenchOptions bench;
  bench.backend = options.backend;
  bench.repeats = options.quick ? 3 : options.repeats;
  if (options.quick) bench.cube_side = 20;
  if (options.side > 0) bench.cube_side = options.side;
  return print(bench_contact(bench), options.json);
}

int bench(BenchArguments const& options) {
  if (std::find(options.parts.begin(), options.parts.end(), "accuracy") != options.parts.end())
    return bench_columns(options);
  if (options.formulation == "jst_sph") return bench_jst(options);
  if (options.formulation == "taylor_sph") return bench_taylor(options);
  if (options.formulation == "adaptle") return bench_impact(options);
  if (options.formulation == "nodal") return bench_of_nodal(options);
  if (options.formulation == "contact") return bench_of_contact(options);
  throw InputError(fmt::format(
      "no benchmark is named '{}' (known: nodal, jst_sph, taylor_sph, adaptle, contact) - give one of these",
      options.formulation));
}

}  // namespace

void add_bench(CLI::App& program, Action& action) {
  auto const options = std::make_shared<BenchArguments>();
  CLI::App* command = program.add_subcommand("bench", "Measure the speed of the solver on this computer");
  command->add_option("formulation", options->formulation,
                      "What to measure: jst_sph (default), nodal, taylor_sph, adaptle or contact");
  command
      ->add_option(
          "--only", options->parts,
          "Parts to measure: rates (particle-stages per second; jst_sph, nodal), column (simulated time per processor "
          "time of the twisting column; jst_sph), variables (cost of the filter, of J and of H; jst_sph), set-up (part "
          "by part; nodal); default: all of these. Or accuracy: errors of nodal and jst_sph against processor time, "
          "some "
          "minutes")
      ->check(CLI::IsMember({"rates", "column", "variables", "set-up", "accuracy"}));
  command->add_flag("--json", options->json, "Print one JSON document");
  command->add_flag("--quick", options->quick, "A few seconds only: fewer particles and steps");
  command
      ->add_option("--side", options->side,
                   "Particles per side of the cube (default 64; nodal 60; contact 40), of the plate (320)")
      ->check(CLI::Range(8, 512));
  command->add_option("--repeats", options->repeats, "Time steps per measurement, the fastest counts (default 8)")
      ->check(CLI::Range(1, 1000));
  command->add_option("--threads", options->threads, "Numbers of threads (default 1 2)")->check(CLI::Range(1, 1024));
  add_instruction_set(*command, options->backend, "Instruction set beside the scalar path (default auto)");
  command->callback([options, &action] { action = [options] { return bench(*options); }; });
}

}  // namespace piola::app
