// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench_adaptle.hpp"
#include "piola/base/errors.hpp"
#include "piola/bench/bench_support.hpp"
#include "piola/exec/backend_registry.hpp"
#include "piola/formulations/adaptle/state.hpp"
#include "piola/formulations/make_formulation.hpp"
#include "piola/setup/shapes.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

/// Density, Young's modulus, Poisson's ratio, yield stress.
constexpr std::array steel{8000.0, 200e9, 0.3, 3e8};

struct ImpactBenchmarkCase {
  char const* name;
  int dimension;
  char const* description;
  char const* correction;
  double artificial_stress;
  bool lattice = false;  ///< places are not jittered
};

Assembly body(ImpactBenchmarkCase const& subject, int cube_side, std::string const& backend) {
  Assembly a;
  int const side = subject.dimension == 3 ? cube_side : static_cast<int>(std::lround(std::pow(cube_side, 1.5)));
  ShapeSpec shape;
  shape.dimension = subject.dimension;
  shape.placement = ShapeSpec::Placement::cell_centred;
  shape.jitter = subject.lattice ? 0 : 0.2;
  for (int c = 0; c < subject.dimension; ++c) {
    auto const k = static_cast<std::size_t>(c);
    shape.particles[k] = side;
    shape.max[k] = 1;
  }
  fill(shape, "body", a.particles);
  MaterialParameters material;
  LawInfo const law = *find_law("perfectly_plastic");
  material.law = law.index;
  for (std::size_t k = 0; k < law.parameters.size(); ++k)
    if (!law.parameters[k].required()) material.value[k] = law.parameters[k].default_value;
  std::copy(steel.begin(), steel.end(), material.value);
  a.materials = {material};
  FormulationSpec spec{
      "adaptle",
      {{"smoothing_length", 1.2},
       {"material_smoothing_length", 1.2},
       {"artificial_stress", subject.artificial_stress},
       {"blend", 0}},
      {{"description", subject.description}, {"correction", subject.correction}, {"viscosity_form", "central"}}};
  if (std::string_view(subject.description) == "patch") spec.formulas.emplace("eulerian_where", Expression("X > 0.5"));
  a.formulations = {spec};
  for (auto const& X : a.particles.X) a.initial_velocity.push_back({std::sin(6 * X[0]), std::cos(5 * X[1]), 0});
  a.backend = backend;
  return a;
}

/// Shares of the parts of a step, from the costs before and after.
std::vector<std::pair<std::string, double>> shares(std::vector<std::pair<std::string, double>> const& before,
                                                   std::vector<std::pair<std::string, double>> const& after) {
  double sum = 0;
  std::vector<std::pair<std::string, double>> r;
  for (std::size_t k = 0; k < after.size(); ++k) {
    r.emplace_back(after[k].first, after[k].second - before[k].second);
    sum += r.back().second;
  }
  for (auto& [name, share] : r) share /= sum > 0 ? sum : 1;
  return r;
}

void measure(AdaptleBenchReport& report, AdaptleBenchOptions const& options, ImpactBenchmarkCase const& subject,
             std::string const& backend) {
  Assembly const assembly = body(subject, options.cube_side, backend);
  auto const particles = assembly.particles.size();
  auto const formulation = make_formulation(assembly);
  for (int const threads : options.threads) {
    pin_to(threads);
    AdaptleBenchRow row;
    row.name = subject.name;
    row.backend = backend;
    row.threads = threads;
    auto const before = formulation->timings();
    Timing const t = fastest_step(*formulation, options.repeats);
    row.parts = shares(before, formulation->timings());
    row.neighbours = mean_neighbours(*formulation, particles);
    row.fill(*formulation, particles, t);
    report.rows.push_back(row);
  }
}

}  // namespace

AdaptleBenchReport bench_adaptle(AdaptleBenchOptions const& options) {
  adaptle::Backend const* const backend = &adaptle::choose_backend(options.backend.c_str());
  AdaptleBenchReport report;
  report.backend = backend->name;
  report.lanes = backend->lanes;
  ImpactBenchmarkCase const subjects[] = {
      {"cube, Eulerian", 3, "eulerian", "none", 0},
      {"cube, Eulerian, artificial stress", 3, "eulerian", "none", 0.3},
      {"cube, Eulerian, corrected", 3, "eulerian", "mixed", 0},
      {"cube, total-Lagrangian", 3, "total_lagrangian", "material", 0},
      {"cube, total-Lagrangian, lattice", 3, "total_lagrangian", "material", 0, true},
      {"cube, half and half", 3, "patch", "material", 0},
      {"plate, Eulerian", 2, "eulerian", "none", 0},
      {"plate, total-Lagrangian", 2, "total_lagrangian", "material", 0}};
  for (auto const& subject : subjects)
    for (std::string const& name : speedup_over_scalar(report.backend, adaptle::backend_names()))
      measure(report, options, subject, name);
  return report;
}

std::string to_json(AdaptleBenchReport const& report) {
  nlohmann::ordered_json j;
  j["formulation"] = "adaptle";
  j["machine"] = report.backend;
  j["lanes"] = report.lanes;
  for (auto const& row : report.rows) {
    nlohmann::ordered_json parts;
    for (auto const& [name, share] : row.parts) parts[name] = share;
    auto r = row.json();
    r["particle_steps_per_second"] = row.per_second;
    r["particle_steps_per_cpu_second"] = row.per_cpu_second;
    r["parts"] = parts;
    j["rows"].push_back(std::move(r));
  }
  return j.dump(2) + "\n";
}

std::string to_text(AdaptleBenchReport const& report) {
  std::string text = fmt::format(
      "AdapTLE on this machine, double precision, machine {} of {} lanes\n"
      "\nwhole time steps of one force evaluation, lists anew in each, threads pinned\n"
      "{:<34} {:>8} {:>7} {:>9} {:>6} {:>11} {:>10} {:>12}  {}\n",
      report.backend, report.lanes, "", "machine", "threads", "particles", "pairs", "bytes/part.", "M p.st./s",
      "M p.st./cpu s", "lists / sweeps / points");
  for (auto const& row : report.rows) {
    text += fmt::format("{:<34} {:>8} {:>7} {:>9} {:>6.1f} {:>11.0f} {:>10.2f} {:>12.2f}  ", row.name, row.backend,
                        row.threads, row.particles, row.neighbours, row.bytes_per_particle, row.per_second * 1e-6,
                        row.per_cpu_second * 1e-6);
    for (std::size_t k = 0; k < row.parts.size() && k < 3; ++k)
      text += fmt::format("{}{:.0f} %", k > 0 ? " / " : "", 100 * row.parts[k].second);
    text += "\n";
  }
  return text +
         "pairs: neighbours of a particle; M p.st./s: particle-steps by wall time; M p.st./cpu s: by processor time, "
         "the "
         "figure to compare on a machine that others use too\n";
}

}  // namespace piola
