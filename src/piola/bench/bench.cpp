// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench.hpp"
#include "piola/base/errors.hpp"
#include "piola/bench/bench_columns.hpp"
#include "piola/bench/bench_support.hpp"
#include "piola/exec/backend_registry.hpp"
#include "piola/exec/memory.hpp"
#include "piola/formulations/jst_sph/state.hpp"
#include "piola/formulations/make_formulation.hpp"
#include "piola/geometry/primitives.hpp"
#include "piola/setup/packed_bodies.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

namespace piola {
namespace {

// Counted by hand from passes.hpp, D = 3, literal biharmonic, regular lattice; bench/README.md has the count.
constexpr double operations_per_pair = 38;
constexpr double doubles_per_stage = 99;

/// A free body about (1/2, 1/2, 1/2) that turns slowly.
Assembly spinning(ShapeSpec const& shape, std::string const& scheme, std::string const& backend) {
  Assembly a;
  fill(shape, "body", a.particles);
  a.materials = {rubber()};
  a.formulations = {FormulationSpec{"jst_sph", {}, {{"scheme", scheme}}}};
  for (auto const& X : a.particles.X) a.initial_velocity.push_back({-5 * (X[1] - 0.5), 5 * (X[0] - 0.5), 0});
  a.backend = backend;
  return a;
}

Assembly spinning_cube(int n, std::string const& scheme, double jitter, std::string const& backend) {
  ShapeSpec shape;
  shape.particles = {n, n, n};
  shape.max = {1, 1, 1};
  shape.jitter = jitter;
  return spinning(shape, scheme, backend);
}

/// A ball that is packed with n particles across, both supports one spacing.
Assembly packed_ball(int n, std::string const& backend) {
  constexpr double radius = 0.5;
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::solid;
  shape.arrangement = ShapeSpec::Arrangement::packed;
  shape.solid = geometry::ball({{radius, radius, radius}}, radius, 0, 3);
  shape.volume = 4 * std::numbers::pi / 3 * radius * radius * radius;
  shape.spacing = 2 * radius / n;
  shape.solid_particles = std::make_shared<SolidParticles>();
  Assembly a = spinning(shape, "paper", backend);
  a.formulations[0].numbers = {{"gradient_support", 1}, {"laplacian_support", 1}};
  return a;
}

void measure_peaks(BenchReport& report, jst_sph::Backend const& backend) {
  constexpr long rounds = 4'000'000;
  constexpr int chains = 16;
  constexpr Index n = 1 << 24;
  Memory from(n), to(n);
  double fma = std::numeric_limits<double>::infinity(), copied = fma;
  volatile double keep = 0;
  for (int k = 0; k < 5; ++k) {
    double start = cpu_seconds();
    keep = keep + backend.run_fma_chains(rounds);
    fma = std::min(fma, cpu_seconds() - start);
    start = cpu_seconds();
    backend.copy(from.data(), to.data(), n);
    copied = std::min(copied, cpu_seconds() - start);
  }
  report.fma_per_second = chains * static_cast<double>(rounds) / fma;
  report.copy_bytes_per_second = 2.0 * sizeof(double) * n / copied;
}

void measure_column(BenchReport& report, BenchOptions const& options) {
  struct Choice {
    char const* name;
    std::map<std::string, double, std::less<>> numbers;
  };
  Choice const choices[] = {{"default, one support 1.2", {{"gradient_support", 1.2}, {"laplacian_support", 1.2}}},
                            {"default", {}}};
  pin_to(1);
  for (auto const& choice : choices) {
    Assembly const assembly = column(Column::twisting, options.column_particles, rubber(),
                                     FormulationSpec{"jst_sph", choice.numbers, {}}, report.backend);
    report.column_particles = static_cast<long>(assembly.particles.size());
    auto const formulation = make_formulation(assembly);
    ColumnRow row{choice.name, mean_neighbours(*formulation, assembly.particles.size()), options.column_steps};
    double const from = take_steps(*formulation, 0, options.column_settling), start = cpu_seconds();
    double const to = take_steps(*formulation, from, row.steps);
    row.cpu = cpu_seconds() - start;
    row.simulated = to - from;
    report.column.push_back(row);
  }
}

void measure_variables(BenchReport& report, BenchOptions const& options) {
  struct Choice {
    char const *name, *scheme, *variables;
    double poissons_ratio;
  };
  constexpr Choice choices[] = {{"{p,F}, paper", "paper", "pF", 0.3},
                                {"{p,F,J}, paper", "paper", "pFJ", 0.3},
                                {"{p,F,H,J}, paper", "paper", "pFHJ", 0.3},
                                {"{p,F}, no filter", "filtered", "pF", 0.3},
                                {"{p,F}, filter", "filtered", "pF", 0.45}};
  pin_to(1);
  std::vector<std::unique_ptr<Formulation>> formulations;
  std::vector<double> cpu(std::size(choices), std::numeric_limits<double>::infinity());
  int const side = std::min(options.particles_per_side, 40);
  for (auto const& choice : choices) {
    Assembly assembly = spinning_cube(side, choice.scheme, 0, report.backend);
    assembly.formulations[0].words["variables"] = choice.variables;
    assembly.materials = {rubber(choice.poissons_ratio)};
    report.variables_particles = static_cast<long>(assembly.particles.size());
    formulations.push_back(make_formulation(assembly));
    report.variables.push_back({choice.name, mean_neighbours(*formulations.back(), assembly.particles.size())});
  }
  // Alternating, so that disturbances of the computer affect all of them.
  for (int round = 0; round < options.repeats; ++round)
    for (std::size_t k = 0; k < formulations.size(); ++k)
      cpu[k] = std::min(cpu[k], fastest_step(*formulations[k], 1).cpu);
  for (std::size_t k = 0; k < formulations.size(); ++k) {
    double const stages = formulations[k]->stages_per_step() * static_cast<double>(report.variables_particles);
    report.variables[k].right_sides_per_cpu_second = stages / cpu[k];
    report.variables[k].relative_cost =
        report.variables[0].right_sides_per_cpu_second / report.variables[k].right_sides_per_cpu_second;
  }
}

struct BenchmarkCase {
  char const* name;
  char const* scheme;
  double jitter;
  bool scalar, counted, packed = false;
};

Assembly body_of(BenchmarkCase const& subject, BenchOptions const& options, std::string const& backend) {
  // Packing more takes longer than all the rest; the lists of these are larger than the second-level cache.
  constexpr int most_packed_across = 48;
  if (subject.packed) return packed_ball(std::min(options.particles_per_side, most_packed_across), backend);
  return spinning_cube(options.particles_per_side, subject.scheme, subject.jitter, backend);
}

void measure_rates(BenchReport& report, BenchOptions const& options) {
  constexpr BenchmarkCase subjects[] = {{"paper, regular lattice", "paper", 0, false, true},
                                        {"paper, jittered (lists)", "paper", 0.2, false, false},
                                        {"paper, packed ball, h = dx", "paper", 0, false, false, true},
                                        {"filtered, regular lattice", "filtered", 0, false, false},
                                        {"paper, plain scalar path", "paper", 0, true, false}};
  bool const has_scalar = jst_sph::find_backend("scalar") != nullptr;
  for (auto const& subject : subjects) {
    if (subject.scalar && !has_scalar) continue;
    auto const assembly = body_of(subject, options, subject.scalar ? "scalar" : report.backend);
    auto const formulation = make_formulation(assembly);
    auto const particles = static_cast<double>(assembly.particles.size());
    if (!subject.packed) report.particles = static_cast<long>(assembly.particles.size());
    double const neighbours = mean_neighbours(*formulation, assembly.particles.size());
    for (int const threads : options.threads) {
      pin_to(threads);
      Timing const best = fastest_step(*formulation, options.repeats);
      double const stages = formulation->stages_per_step() * particles;
      BenchRow row{subject.name, subject.scalar ? "scalar" : report.backend, threads,
                   static_cast<long>(assembly.particles.size())};
      row.neighbours = neighbours;
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
}

}  // namespace

BenchReport bench_jst_sph(BenchOptions const& options) {
  jst_sph::Backend const* const backend = &jst_sph::choose_backend(options.backend.c_str());
  BenchReport report;
  report.backend = backend->name;
  report.lanes = backend->lanes;
  pin_to(1);
  measure_peaks(report, *backend);
  if (options.rates) measure_rates(report, options);
  if (options.column) measure_column(report, options);
  if (options.variables) measure_variables(report, options);
  return report;
}

std::string to_json(BenchReport const& report) {
  nlohmann::ordered_json j;
  j["formulation"] = "jst_sph";
  j["particles"] = report.particles;
  j["machine"] = report.backend;
  j["lanes"] = report.lanes;
  j["vector_fma_per_second"] = report.fma_per_second;
  j["copy_bytes_per_second"] = report.copy_bytes_per_second;
  j["operations_per_pair"] = report.operations_per_pair;
  j["bytes_per_stage"] = report.bytes_per_stage;
  j["arithmetic_bound"] = report.arithmetic_bound;
  j["memory_bound"] = report.memory_bound;
  for (auto const& row : report.rows)
    j["rows"].push_back({{"name", row.name},
                         {"machine", row.backend},
                         {"threads", row.threads},
                         {"particles", row.particles},
                         {"neighbours", row.neighbours},
                         {"bytes_per_particle", row.bytes_per_particle},
                         {"stages_per_second", row.stages_per_second},
                         {"stages_per_cpu_second", row.stages_per_cpu_second},
                         {"roofline_fraction", row.roofline_fraction}});
  for (auto const& row : report.column)
    j["column"].push_back({{"name", row.name},
                           {"particles", report.column_particles},
                           {"neighbours", row.neighbours},
                           {"steps", row.steps},
                           {"simulated_seconds", row.simulated},
                           {"cpu_seconds", row.cpu},
                           {"simulated_ms_per_cpu_second", row.milliseconds_per_cpu_second()}});
  for (auto const& row : report.variables)
    j["variables"].push_back({{"name", row.name},
                              {"particles", report.variables_particles},
                              {"neighbours", row.neighbours},
                              {"right_sides_per_cpu_second", row.right_sides_per_cpu_second},
                              {"relative_cost", row.relative_cost}});
  return j.dump(2) + "\n";
}

namespace {

std::string rates_text(BenchReport const& report) {
  std::string text = fmt::format(
      "\nfull right-hand side of {{p,F}}, whole time steps, threads pinned\n"
      "roofline of the regular lattice: arithmetic {:.1f} M, memory {:.1f} M particle-stages/s per core ({:.0f} "
      "operations per pair, {:.0f} bytes per stage)\n"
      "{:<28} {:>8} {:>8} {:>9} {:>6} {:>11} {:>13} {:>13} {:>9}\n",
      report.arithmetic_bound * 1e-6, report.memory_bound * 1e-6, report.operations_per_pair, report.bytes_per_stage,
      "", "machine", "threads", "particles", "pairs", "bytes/part.", "M stages/s", "M st./cpu s", "roofline");
  for (auto const& row : report.rows) {
    std::string const fraction = row.roofline_fraction > 0 ? fmt::format("{:.0f} %", 100 * row.roofline_fraction) : "";
    text += fmt::format("{:<28} {:>8} {:>8} {:>9} {:>6.1f} {:>11.0f} {:>13.2f} {:>13.2f} {:>9}\n", row.name,
                        row.backend, row.threads, row.particles, row.neighbours, row.bytes_per_particle,
                        row.stages_per_second * 1e-6, row.stages_per_cpu_second * 1e-6, fraction);
  }
  return text +
         "M stages/s: by wall time; M st./cpu s: by processor time, the figure to compare on a machine that others use "
         "too\n";
}

std::string column_text(BenchReport const& report) {
  std::string text = fmt::format(
      "\ntwisting column, {} particles, default scheme, one thread\n"
      "{:<28} {:>6} {:>8} {:>13} {:>9} {:>26}\n",
      report.column_particles, "", "pairs", "steps", "simulated ms", "cpu s", "simulated ms per cpu second");
  for (auto const& row : report.column)
    text += fmt::format("{:<28} {:>6.1f} {:>8} {:>13.3f} {:>9.2f} {:>26.2f}\n", row.name, row.neighbours, row.steps,
                        1e3 * row.simulated, row.cpu, row.milliseconds_per_cpu_second());
  return text;
}

std::string variables_text(BenchReport const& report) {
  std::string text = fmt::format(
      "\nunknowns and filter, {} particles, one thread\n"
      "{:<28} {:>6} {:>26} {:>24}\n",
      report.variables_particles, "", "pairs", "M right-hand sides/cpu s", "time per right-hand side");
  for (auto const& row : report.variables)
    text += fmt::format("{:<28} {:>6.1f} {:>26.2f} {:>24.2f}\n", row.name, row.neighbours,
                        row.right_sides_per_cpu_second * 1e-6, row.relative_cost);
  return text;
}

}  // namespace

std::string to_text(BenchReport const& report) {
  std::string text = fmt::format(
      "JST-SPH on this machine, double precision\n"
      "machine {}: {:.2f} G vector multiply-adds/s of {} lanes, copy {:.1f} GB/s (one core)\n",
      report.backend, report.fma_per_second * 1e-9, report.lanes, report.copy_bytes_per_second * 1e-9);
  if (!report.rows.empty()) text += rates_text(report);
  if (!report.column.empty()) text += column_text(report);
  if (!report.variables.empty()) text += variables_text(report);
  return text;
}

}  // namespace piola
