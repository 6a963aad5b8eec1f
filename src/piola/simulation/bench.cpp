// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/bench.hpp"
#include "piola/base/problems.hpp"
#include "piola/exec/memory.hpp"
#include "piola/exec/threads.hpp"
#include "piola/formulations/jst_sph/state.hpp"
#include "piola/formulations/make.hpp"
#include "piola/setup/shapes.hpp"
#include <algorithm>
#include <chrono>
#include <ctime>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

namespace piola {
namespace {

// Counted by hand from passes.hpp, D = 3, literal biharmonic, regular lattice; bench/README.md has the count.
constexpr double operations_per_pair = 38;
constexpr double doubles_per_stage = 99;

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Assembly spinning_cube(int n, std::string const& scheme, double jitter, std::string const& machine) {
  Assembly a;
  ShapeSpec shape;
  shape.particles = {n, n, n};
  shape.max = {1, 1, 1};
  shape.jitter = jitter;
  fill(shape, "cube", a.particles);
  MaterialParameters material;
  material.law = find_law("neo_hookean")->index;
  std::array const values{1100.0, 17e6, 0.45};
  std::copy(values.begin(), values.end(), material.value);
  a.materials = {material};
  a.formulations = {FormulationSpec{"jst_sph", {}, {{"scheme", scheme}}}};
  for (auto const& X : a.particles.X) a.initial_velocity.push_back({-5 * (X[1] - 0.5), 5 * (X[0] - 0.5), 0});
  a.machine = machine;
  return a;
}

struct Timing {
  double wall, cpu;
};

/// Fastest of several whole time steps.
Timing fastest_step(Formulation& formulation, int repeats) {
  Timing best{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  double time = 0;
  for (int k = 0; k <= repeats; ++k) {
    double const wall = wall_seconds(), cpu = cpu_seconds();
    double const dt = formulation.stable_time_step();
    formulation.step(time, dt);
    time += dt;
    if (k == 0) continue;  // the first step warms caches and threads
    best.wall = std::min(best.wall, wall_seconds() - wall);
    best.cpu = std::min(best.cpu, cpu_seconds() - cpu);
  }
  return best;
}

void measure_peaks(BenchReport& report, jst_sph::Machine const& machine) {
  constexpr long rounds = 4'000'000;
  constexpr int chains = 16;
  constexpr Index n = 1 << 24;
  Memory from(n), to(n);
  double fma = std::numeric_limits<double>::infinity(), copied = fma;
  volatile double keep = 0;
  for (int k = 0; k < 5; ++k) {
    double start = cpu_seconds();
    keep = keep + machine.run_fma_chains(rounds);
    fma = std::min(fma, cpu_seconds() - start);
    start = cpu_seconds();
    machine.copy(from.data(), to.data(), n);
    copied = std::min(copied, cpu_seconds() - start);
  }
  report.fma_per_second = chains * static_cast<double>(rounds) / fma;
  report.copy_bytes_per_second = 2.0 * sizeof(double) * n / copied;
}

struct Subject {
  char const* name;
  char const* scheme;
  double jitter;
  bool scalar, counted;
};

}  // namespace

BenchReport bench_jst_sph(BenchOptions const& options) {
  jst_sph::Machine const* const machine = jst_sph::find_machine(options.machine.c_str());
  if (machine == nullptr)
    throw InputError(fmt::format("machine '{}' is unknown or not usable on this processor", options.machine));
  BenchReport report;
  report.machine = machine->name;
  report.lanes = machine->lanes;
  exec_host::set_threads(1);
  exec_host::pin_threads();
  measure_peaks(report, *machine);
  constexpr Subject subjects[] = {{"paper, regular lattice", "paper", 0, false, true},
                                  {"paper, jittered (lists)", "paper", 0.2, false, false},
                                  {"robust, regular lattice", "robust", 0, false, false},
                                  {"paper, plain scalar path", "paper", 0, true, false}};
  for (auto const& subject : subjects) {
    auto const assembly = spinning_cube(options.particles_per_side, subject.scheme, subject.jitter,
                                        subject.scalar ? "scalar" : machine->name);
    auto const formulation = make_formulation(assembly);
    auto const particles = static_cast<double>(assembly.particles.size());
    report.particles = static_cast<long>(assembly.particles.size());
    std::vector<double> neighbours(assembly.particles.X.size());
    formulation->sample("Neighbours", neighbours);
    for (int const threads : options.threads) {
      exec_host::set_threads(threads);
      exec_host::pin_threads();
      Timing const best = fastest_step(*formulation, options.repeats);
      double const stages = formulation->stages_per_step() * particles;
      BenchRow row{subject.name, subject.scalar ? "scalar" : machine->name, threads};
      row.neighbours = std::accumulate(neighbours.begin(), neighbours.end(), 0.0) / particles;
      row.bytes_per_particle = static_cast<double>(formulation->memory_bytes()) / particles;
      row.stages_per_second = stages / best.wall;
      row.stages_per_cpu_second = stages * threads / best.cpu;
      if (subject.counted) {
        report.operations_per_pair = operations_per_pair;
        report.bytes_per_stage = doubles_per_stage * sizeof(double);
        report.arithmetic_bound = report.fma_per_second * report.lanes / (operations_per_pair * row.neighbours);
        report.memory_bound = report.copy_bytes_per_second / report.bytes_per_stage;
        row.roofline_fraction =
            row.stages_per_cpu_second / threads / std::min(report.arithmetic_bound, report.memory_bound);
      }
      report.rows.push_back(row);
    }
  }
  return report;
}

std::string to_json(BenchReport const& report) {
  nlohmann::ordered_json j;
  j["formulation"] = "jst_sph";
  j["particles"] = report.particles;
  j["machine"] = report.machine;
  j["lanes"] = report.lanes;
  j["vector_fma_per_second"] = report.fma_per_second;
  j["copy_bytes_per_second"] = report.copy_bytes_per_second;
  j["operations_per_pair"] = report.operations_per_pair;
  j["bytes_per_stage"] = report.bytes_per_stage;
  j["arithmetic_bound"] = report.arithmetic_bound;
  j["memory_bound"] = report.memory_bound;
  for (auto const& row : report.rows)
    j["rows"].push_back({{"name", row.name},
                         {"machine", row.machine},
                         {"threads", row.threads},
                         {"neighbours", row.neighbours},
                         {"bytes_per_particle", row.bytes_per_particle},
                         {"stages_per_second", row.stages_per_second},
                         {"stages_per_cpu_second", row.stages_per_cpu_second},
                         {"roofline_fraction", row.roofline_fraction}});
  return j.dump(2) + "\n";
}

std::string to_text(BenchReport const& report) {
  std::string text = fmt::format(
      "JST-SPH, full right-hand side of {{p,F}}: whole time steps of {} particles, double, threads pinned\n"
      "machine {}: {:.2f} G vector multiply-adds/s of {} lanes, copy {:.1f} GB/s (one core)\n"
      "roofline of the regular lattice: arithmetic {:.1f} M, memory {:.1f} M particle-stages/s per core ({:.0f} "
      "operations per pair, "
      "{:.0f} bytes per stage)\n\n"
      "{:<28} {:>8} {:>8} {:>6} {:>11} {:>13} {:>13} {:>9}\n",
      report.particles, report.machine, report.fma_per_second * 1e-9, report.lanes, report.copy_bytes_per_second * 1e-9,
      report.arithmetic_bound * 1e-6, report.memory_bound * 1e-6, report.operations_per_pair, report.bytes_per_stage,
      "", "machine", "threads", "pairs", "bytes/part.", "M stages/s", "M st./cpu s", "roofline");
  for (auto const& row : report.rows) {
    std::string const fraction = row.roofline_fraction > 0 ? fmt::format("{:.0f} %", 100 * row.roofline_fraction) : "";
    text += fmt::format("{:<28} {:>8} {:>8} {:>6.1f} {:>11.0f} {:>13.2f} {:>13.2f} {:>9}\n", row.name, row.machine,
                        row.threads, row.neighbours, row.bytes_per_particle, row.stages_per_second * 1e-6,
                        row.stages_per_cpu_second * 1e-6, fraction);
  }
  text +=
      "\nM stages/s: by wall time; M st./cpu s: by processor time, the figure to compare on a machine that others use "
      "too\n";
  return text;
}

}  // namespace piola
