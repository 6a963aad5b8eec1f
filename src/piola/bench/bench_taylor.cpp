// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench_taylor.hpp"
#include "piola/base/errors.hpp"
#include "piola/bench/bench_support.hpp"
#include "piola/exec/backend_registry.hpp"
#include "piola/formulations/make_formulation.hpp"
#include "piola/formulations/taylor_sph/state.hpp"
#include "piola/neighbours/mesh_cells.hpp"
#include "piola/setup/shapes.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

namespace piola {
namespace {

/// Density, Young's modulus, Poisson's ratio.
constexpr std::array soft_solid{1000.0, 1e6, 0.3};

struct TaylorBenchmarkCase {
  char const* name;
  int dimension, side;
  char const* configuration;
  char const* virtual_particles;
  char const* exchange;
  bool deforming;  ///< strained by a wave, so that lists do not last; all steps count
};

/// Speed by which shear waves of 40 spacings reach strains of 0.25: lists last for 10 to 20 steps then.
double shear_speed(double Y, int side) {
  auto const [density, youngs_modulus, poissons_ratio] = soft_solid;
  double const c = std::sqrt(youngs_modulus / (2 * (1 + poissons_ratio) * density)), waves = std::max(1.0, side / 40.0);
  return 0.25 * c * std::sin(2 * std::numbers::pi * waves * Y);
}

Assembly body(TaylorBenchmarkCase const& subject, std::string const& backend) {
  Assembly a;
  ShapeSpec shape;
  shape.dimension = subject.dimension;
  for (int c = 0; c < subject.dimension; ++c) {
    auto const k = static_cast<std::size_t>(c);
    shape.particles[k] = subject.side;
    shape.max[k] = 1;
  }
  fill(shape, "body", a.particles);
  MaterialParameters material;
  material.law = find_law("linear_elastic")->index;
  std::copy(soft_solid.begin(), soft_solid.end(), material.value);
  a.materials = {material};
  a.formulations = {FormulationSpec{"taylor_sph",
                                    {},
                                    {{"configuration", subject.configuration},
                                     {"virtual_particles", subject.virtual_particles},
                                     {"exchange", subject.exchange}}}};
  for (auto const& X : a.particles.X)
    a.initial_velocity.push_back(
        {subject.deforming ? shear_speed(X[1], subject.side) : 1e-3 * std::sin(2 * X[0]), 0, 0});
  a.backend = backend;
  return a;
}

long list_updates(Formulation const& formulation) {
  for (auto const& [name, value] : formulation.diagnose().more)
    if (name == "list_updates") return static_cast<long>(value);
  return 0;
}

/// The mean of all steps, after one that warms caches and threads.
Timing mean_step(Formulation& formulation, int steps) {
  double const time = take_steps(formulation, 0, 1);
  double const wall = wall_seconds(), cpu = cpu_seconds();
  take_steps(formulation, time, steps);
  return {(wall_seconds() - wall) / steps, (cpu_seconds() - cpu) / steps};
}

void measure(TaylorBenchReport& report, TaylorBenchOptions const& options, TaylorBenchmarkCase const& subject,
             std::string const& backend) {
  Assembly const assembly = body(subject, backend);
  auto const particles = assembly.particles.size();
  std::unique_ptr<Formulation> formulation;
  for (int const threads : options.threads) {
    pin_to(threads);
    // The wave changes over steps: each number of threads starts with a new one.
    if (!formulation || subject.deforming) formulation = make_formulation(assembly);
    TaylorBenchRow row{{subject.name, backend, threads}};
    row.neighbours = mean_neighbours(*formulation, particles);
    long const before = list_updates(*formulation);
    Timing const t =
        subject.deforming ? mean_step(*formulation, options.steps) : fastest_step(*formulation, options.repeats);
    row.list_updates = list_updates(*formulation) - before;
    row.fill(*formulation, particles, t);
    report.rows.push_back(row);
  }
}

/// Processor time of one thread for a step, for an update of lists and for a triangulation of the deformed plate.
TaylorUpkeep measure_upkeep(TaylorBenchOptions const& options, TaylorBenchmarkCase const& subject,
                            std::string const& backend) {
  pin_to(1);
  Assembly const assembly = body(subject, backend);
  auto const formulation = make_formulation(assembly);
  auto const particles = static_cast<std::size_t>(assembly.particles.size());
  TaylorUpkeep r{static_cast<long>(particles)};
  std::vector<double> with;  // time of a step that made lists
  r.step = std::numeric_limits<double>::infinity();
  double time = 0;
  for (int k = 0; k < options.steps; ++k) {
    long const before = list_updates(*formulation);
    double const start = cpu_seconds();
    time = take_steps(*formulation, time, 1);
    double const took = cpu_seconds() - start;
    if (list_updates(*formulation) > before)
      with.push_back(took);
    else
      r.step = std::min(r.step, took);
  }
  if (!with.empty()) r.list_update = *std::min_element(with.begin(), with.end()) - r.step;
  std::vector<double> x(3 * particles);
  formulation->sample("Position", x);
  Points points(particles);
  for (std::size_t i = 0; i < x.size(); ++i) points[i / 3][i % 3] = x[i];
  double const start = cpu_seconds();
  r.cells = delaunay(points, subject.dimension, 3 * assembly.particles.bodies[0].spacing[0]).count();
  r.triangulation = cpu_seconds() - start;
  return r;
}

}  // namespace

TaylorBenchReport bench_taylor_sph(TaylorBenchOptions const& options) {
  taylor_sph::Backend const* const backend = &taylor_sph::choose_backend(options.backend.c_str());
  TaylorBenchReport report;
  report.backend = backend->name;
  report.lanes = backend->lanes;
  constexpr char const *triangles = "delaunay", *boxes = "lattice_cells";
  constexpr char const *adjoint = "adjoint", *kernel_sums = "kernel_sums";
  int const plate = options.plate_side, cube = options.cube_side;
  TaylorBenchmarkCase const deforming{"plate, moving, lists follow", 2, plate, "updated", triangles, kernel_sums, true};
  TaylorBenchmarkCase const subjects[] = {
      {"plate, fixed", 2, plate, "fixed", triangles, kernel_sums, false},
      {"plate, moving", 2, plate, "updated", triangles, kernel_sums, false},
      {"plate, moving, adjoint", 2, plate, "updated", triangles, adjoint, false},
      deforming,
      {"plate, moving, boxes", 2, plate, "updated", boxes, kernel_sums, false},
      {"bar, fixed", 1, options.bar_particles, "fixed", triangles, kernel_sums, false},
      {"cube, fixed", 3, cube, "fixed", triangles, kernel_sums, false},
      {"cube, moving, boxes", 3, cube, "updated", boxes, kernel_sums, false},
      {"cube, moving, adjoint", 3, cube, "updated", triangles, adjoint, false}};
  for (auto const& subject : subjects)
    for (std::string const& name : speedup_over_scalar(report.backend, taylor_sph::backend_names()))
      measure(report, options, subject, name);
  report.upkeep = measure_upkeep(options, deforming, report.backend);
  return report;
}

std::string to_json(TaylorBenchReport const& report) {
  nlohmann::ordered_json j;
  j["formulation"] = "taylor_sph";
  j["machine"] = report.backend;
  j["lanes"] = report.lanes;
  for (auto const& row : report.rows) {
    auto r = row.json();
    r["list_updates"] = row.list_updates;
    r["particle_steps_per_second"] = row.per_second;
    r["particle_steps_per_cpu_second"] = row.per_cpu_second;
    j["rows"].push_back(std::move(r));
  }
  TaylorUpkeep const& u = report.upkeep;
  j["upkeep"] = {{"particles", u.particles},
                 {"cells", u.cells},
                 {"step_cpu_seconds", u.step},
                 {"list_update_cpu_seconds", u.list_update},
                 {"triangulation_cpu_seconds", u.triangulation},
                 {"steps_between", TaylorUpkeep::between},
                 {"particle_steps_per_cpu_second", u.per_cpu_second()}};
  return j.dump(2) + "\n";
}

std::string to_text(TaylorBenchReport const& report) {
  std::string text = fmt::format(
      "Taylor-SPH on this machine, double precision, machine {} of {} lanes\n"
      "\nwhole time steps, threads pinned\n"
      "{:<28} {:>8} {:>8} {:>10} {:>6} {:>11} {:>8} {:>10} {:>12}\n",
      report.backend, report.lanes, "", "machine", "threads", "particles", "pairs", "bytes/part.", "updates",
      "M p.st./s", "M p.st./cpu s");
  for (auto const& row : report.rows)
    text += fmt::format("{:<28} {:>8} {:>8} {:>10} {:>6.1f} {:>11.0f} {:>8} {:>10.2f} {:>12.2f}\n", row.name,
                        row.backend, row.threads, row.particles, row.neighbours, row.bytes_per_particle,
                        row.list_updates, row.per_second * 1e-6, row.per_cpu_second * 1e-6);
  TaylorUpkeep const& u = report.upkeep;
  return text +
         fmt::format(
             "pairs: virtual particles that a real one sees; M p.st./s: particle-steps by wall time; M p.st./cpu s: by "
             "processor time, the figure to compare on a machine that others use too\n"
             "\ndeforming plate, one thread, processor time: a step {:.1f} ms, an update of lists {:.1f} ms, a "
             "triangulation ({} cells) {:.1f} ms;\n"
             "with both every {} steps: {:.2f} M particle-steps per cpu second\n",
             1e3 * u.step, 1e3 * u.list_update, u.cells, 1e3 * u.triangulation, TaylorUpkeep::between,
             u.per_cpu_second() * 1e-6);
}

}  // namespace piola
