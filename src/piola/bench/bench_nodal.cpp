// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench_nodal.hpp"
#include "piola/base/errors.hpp"
#include "piola/bench/bench_columns.hpp"
#include "piola/bench/bench_support.hpp"
#include "piola/exec/backend_registry.hpp"
#include "piola/formulations/make_formulation.hpp"
#include "piola/formulations/nodal/set_up.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/setup/shapes.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

struct NodalBenchmarkCase {
  std::string name;
  std::array<int, 3> particles;
  double jitter;
};

std::vector<NodalBenchmarkCase> subjects(NodalBenchOptions const& options) {
  int const n = options.cube_side, m = std::min(n, options.cloud_side);
  return {{"cube, lattice", {n, n, n}, 0},
          {"cube, jittered (lists)", {m, m, m}, 0.2},
          {"5 x 25 x 5, lattice", {5, 25, 5}, 0},
          {"5 x 25 x 5, jittered", {5, 25, 5}, 0.2},
          {"3 x 13 x 3, lattice", {3, 13, 3}, 0}};
}

/// Turns slowly about its axis, with steps so short that their limit is not measured.
Assembly body(NodalBenchmarkCase const& subject, std::string const& backend) {
  Assembly a;
  ShapeSpec shape;
  shape.particles = subject.particles;
  for (std::size_t c = 0; c < 3; ++c) shape.max[c] = (subject.particles[c] - 1) / 10.0;
  shape.jitter = subject.jitter;
  fill(shape, "body", a.particles);
  a.materials = {rubber()};
  a.formulations = {FormulationSpec{"nodal", {}, {}}};
  for (auto const& X : a.particles.X) a.initial_velocity.push_back({-X[1], X[0], 0});
  a.backend = backend;
  a.cfl = 0.1;
  return a;
}

void measure_rates(NodalBenchReport& report, NodalBenchOptions const& options, NodalBenchmarkCase const& subject,
                   std::string const& backend) {
  Assembly const assembly = body(subject, backend);
  auto const particles = assembly.particles.size();
  auto const formulation = make_formulation(assembly);
  for (int const threads : options.threads) {
    pin_to(threads);
    RateRow row{subject.name, backend, threads};
    row.neighbours = mean_neighbours(*formulation, particles);
    row.fill(*formulation, particles, fastest_step(*formulation, options.repeats));
    report.rows.push_back(row);
  }
}

nodal::Reference reference_of(ParticleSet const& set, nodal::Backend const& backend, double integration_tolerance) {
  auto const order = nodal::slot_order(set, set.bodies[0]);
  return nodal::make_reference({set, set.bodies[0], order, {}, {}, {1100}, 0.3, backend, nullptr, integration_tolerance});
}

void measure_set_up(NodalBenchReport& report, NodalBenchOptions const& options, NodalBenchmarkCase const& subject,
                    nodal::Backend const& backend) {
  constexpr double enough = 1;  // s: longer measurements are not repeated
  pin_to(1);
  Assembly const assembly = body(subject, report.backend);
  auto const& set = assembly.particles;
  NodalSetUpRow row{subject.name, static_cast<long>(set.size())};
  double const start = wall_seconds();
  for (int k = 0; k < options.repeats && wall_seconds() - start < enough; ++k) {
    auto const reference = reference_of(set, backend, 1e-3);
    auto const least = [&](double& to, double seconds) { to = k == 0 ? seconds : std::min(to, seconds); };
    least(row.cells, reference.costs.cells);
    least(row.fits, reference.costs.fits);
    least(row.integration_correction, reference.costs.integration_correction);
    least(row.masses, reference.costs.masses);
    least(row.tables, reference.costs.tables);
    row.iterations = reference.integration_iterations;
  }
  constexpr long few = 10000;  // larger ones would take minutes
  if (row.particles <= few) row.tight = reference_of(set, backend, 1e-6).integration_iterations;
  row.right_side = fastest_step(*make_formulation(assembly), options.repeats).cpu;
  report.set_up.push_back(row);
}

}  // namespace

NodalBenchReport bench_nodal(NodalBenchOptions const& options) {
  nodal::Backend const* const backend = &nodal::choose_backend(options.backend.c_str());
  NodalBenchReport report;
  report.backend = backend->name;
  report.lanes = backend->lanes;
  for (auto const& subject : subjects(options)) {
    if (options.rates)
      for (std::string const& name : speedup_over_scalar(report.backend, nodal::backend_names()))
        measure_rates(report, options, subject, name);
    if (options.set_up) measure_set_up(report, options, subject, *backend);
  }
  for (int const length : options.lengths)
    if (options.set_up)
      measure_set_up(report, options, {fmt::format("5 x 5 x {}, jittered", length), {5, 5, length}, 0.2}, *backend);
  return report;
}

std::string to_json(NodalBenchReport const& report) {
  nlohmann::ordered_json j;
  j["formulation"] = "nodal";
  j["machine"] = report.backend;
  j["lanes"] = report.lanes;
  for (auto const& row : report.rows) {
    auto r = row.json();
    r["stages_per_second"] = row.per_second;
    r["stages_per_cpu_second"] = row.per_cpu_second;
    j["rows"].push_back(std::move(r));
  }
  for (auto const& row : report.set_up)
    j["set_up"].push_back({{"name", row.name},
                           {"particles", row.particles},
                           {"cells_seconds", row.cells},
                           {"fits_seconds", row.fits},
                           {"closure_seconds", row.integration_correction},
                           {"closure_iterations", row.iterations},
                           {"closure_iterations_tight", row.tight},
                           {"masses_seconds", row.masses},
                           {"tables_seconds", row.tables},
                           {"right_side_seconds", row.right_side}});
  return j.dump(2) + "\n";
}

namespace {

std::string rates_text(NodalBenchReport const& report) {
  std::string text = fmt::format(
      "\nwhole time steps of given length, threads pinned\n"
      "{:<24} {:>8} {:>8} {:>10} {:>6} {:>11} {:>13} {:>13}\n",
      "", "machine", "threads", "particles", "pairs", "bytes/part.", "M stages/s", "M st./cpu s");
  for (auto const& row : report.rows)
    text += fmt::format("{:<24} {:>8} {:>8} {:>10} {:>6.1f} {:>11.0f} {:>13.2f} {:>13.2f}\n", row.name, row.backend,
                        row.threads, row.particles, row.neighbours, row.bytes_per_particle, row.per_second * 1e-6,
                        row.per_cpu_second * 1e-6);
  return text +
         "M stages/s: by wall time; M st./cpu s: by processor time of all threads, the figure to compare on a machine "
         "that others use too\n";
}

std::string set_up_text(NodalBenchReport const& report) {
  std::string text = fmt::format(
      "\nset-up, one thread, ms\n"
      "{:<24} {:>10} {:>8} {:>8} {:>8} {:>10} {:>7} {:>8} {:>8} {:>9} {:>11} {:>7}\n",
      "", "particles", "cells", "fits", "integration_correction", "iterations", "to 1e-6", "masses", "tables", "in all", "right side",
      "fits");
  for (auto const& row : report.set_up)
    text += fmt::format(
        "{:<24} {:>10} {:>8.1f} {:>8.1f} {:>8.1f} {:>10} {:>7} {:>8.1f} {:>8.1f} {:>9.1f} {:>11.3f} {:>7.1f}\n",
        row.name, row.particles, 1e3 * row.cells, 1e3 * row.fits, 1e3 * row.integration_correction, row.iterations,
        row.tight > 0 ? fmt::to_string(row.tight) : "-", 1e3 * row.masses, 1e3 * row.tables, 1e3 * row.total(),
        1e3 * row.right_side, row.fits / row.right_side);
  return text +
         "iterations: of the solve, to 1e-3 of its first residual as runs have it, and to 1e-6; -: not measured\n"
         "right side: one right-hand side of all particles; the last column: the fits, counted in these\n";
}

}  // namespace

std::string to_text(NodalBenchReport const& report) {
  std::string text =
      fmt::format("nodal on this machine, double precision, machine {} of {} lanes\n", report.backend, report.lanes);
  if (!report.rows.empty()) text += rates_text(report);
  if (!report.set_up.empty()) text += set_up_text(report);
  return text;
}

}  // namespace piola
