// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench_accuracy.hpp"
#include "piola/exec/cpu_time.hpp"
#include "piola/exec/threads.hpp"
#include "piola/formulations/make_formulation.hpp"
#include "piola/input/read_case.hpp"
#include "piola/measures/probe.hpp"
#include "piola/measures/quantities.hpp"
#include "piola/simulation/build.hpp"
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

namespace piola {
namespace {

/// A case whose first probe measures a peak.
struct Problem {
  char const *name, *folder;
  double poissons_ratio;
  double reference;  ///< bench/finite_elements/README.md, in `unit`
  double unit;       ///< SI value of the unit of `reference`
  double end;        ///< just after the peak [s]
};

constexpr double degrees = std::numbers::pi / 180;
constexpr Problem studies[] = {{"twist", "nodal/twisting_column", 0.45, 337.5, degrees, 0.12},
                               {"twist", "nodal/twisting_column", 0.499, 342.7, degrees, 0.12},
                               {"bend", "nodal/bending_column", 0.45, 2.997, 1, 0.5},
                               {"bend", "nodal/bending_column", 0.499, 2.987, 1, 0.5}};

struct Scheme {
  char const *name, *settings;
};

constexpr Scheme compared[] = {{"nodal", R"({ name = "nodal" })"},
                               {"jst_sph", R"({ name = "jst_sph" })"},
                               {"jst_sph paper", R"({ name = "jst_sph", scheme = "paper" })"}};

/// Steps to the end of the problem; evaluates the probe at the intervals of the history.
void run(Formulation& formulation, ParticleSet const& particles, Problem const& problem, CaseSpec const& spec,
         AccuracyRow& row) {
  Probe probe(spec.probes.front(), particles);
  double const every = spec.output.history_every;
  std::vector<double> times, values;
  auto const observe = [&](double time) {
    FieldCache cache(formulation, particles);
    times.push_back(time);
    values.push_back(probe.evaluate(cache, time).front());
  };
  observe(0);
  double time = 0;
  while (time < problem.end) {
    double const next = every * (std::floor(time / every) + 1);  // a step may be longer
    double const start = exec_host::processor_time();
    for (; time < next && row.failure.empty(); ++row.steps) {
      double const dt = formulation.stable_time_step();
      if (!(dt > 0)) row.failure = "the time step collapsed";
      formulation.step(time, dt);
      time += dt;
      if (auto const failure = formulation.failure()) row.failure = fmt::format("a particle {}", failure->what);
    }
    row.cpu += exec_host::processor_time() - start;
    if (!row.failure.empty()) return;
    observe(time);
  }
  auto const peak = first_peak(times, values);
  if (!peak || !std::isfinite(peak->value)) {
    row.failure = "no peak";
    return;
  }
  row.value = std::abs(peak->value) / problem.unit;
  row.error = row.value / problem.reference - 1;
}

AccuracyRow measure_run(Problem const& problem, Scheme const& scheme, int across, AccuracyOptions const& options) {
  double const none = std::numeric_limits<double>::quiet_NaN();
  AccuracyRow row{.problem = problem.name,
                  .poissons_ratio = problem.poissons_ratio,
                  .formulation = scheme.name,
                  .across = across,
                  .value = none,
                  .error = none,
                  .failure = {}};
  std::vector<std::string> const settings{
      fmt::format("body.column.shape.particles=[{}, {}, {}]", across, 6 * (across - 1) + 1, across),
      fmt::format("body.column.material.poissons_ratio={}", problem.poissons_ratio),
      fmt::format("body.column.formulation={}", scheme.settings), fmt::format("run.machine={}", options.backend)};
  ParticleSet made;
  CaseSpec const spec = read_case(options.cases / problem.folder, settings, {}, &made);
  Assembly const assembly = assemble(spec, std::move(made));
  row.particles = assembly.particles.size();
  double const start = exec_host::processor_time();
  auto const formulation = make_formulation(assembly);
  row.set_up = row.cpu = exec_host::processor_time() - start;
  run(*formulation, assembly.particles, problem, spec, row);
  return row;
}

}  // namespace

std::vector<AccuracyRow> measure_accuracy(AccuracyOptions const& options) {
  exec_host::set_threads(1);
  exec_host::pin_threads();
  std::vector<AccuracyRow> rows;
  for (auto const& problem : studies)
    for (auto const& scheme : compared)
      for (int const across : options.across) {
        rows.push_back(measure_run(problem, scheme, across, options));
        if (rows.back().cpu > options.longest) break;
      }
  return rows;
}

std::string to_json(std::vector<AccuracyRow> const& rows) {
  nlohmann::ordered_json j;
  for (auto const& row : rows) {
    nlohmann::ordered_json r{{"problem", row.problem},           {"poissons_ratio", row.poissons_ratio},
                             {"formulation", row.formulation},   {"across", row.across},
                             {"particles", row.particles},       {"steps", row.steps},
                             {"set_up_cpu_seconds", row.set_up}, {"cpu_seconds", row.cpu}};
    if (row.failure.empty()) {
      r["value"] = row.value;
      r["error"] = row.error;
    } else {
      r["failure"] = row.failure;
    }
    j["accuracy"].push_back(std::move(r));
  }
  return j.dump(2) + "\n";
}

std::string to_text(std::vector<AccuracyRow> const& rows) {
  std::string text = fmt::format(
      "errors against processor time, one thread; first peak against converged finite elements\n"
      "{:<6} {:>6} {:<16} {:>6} {:>9} {:>7} {:>10} {:>9} {:>9} {:>9}\n",
      "", "nu", "", "across", "particles", "steps", "value", "error", "set-up s", "cpu s");
  for (auto const& row : rows) {
    text += fmt::format("{:<6} {:>6} {:<16} {:>6} {:>9} {:>7} ", row.problem, row.poissons_ratio, row.formulation,
                        row.across, row.particles, row.steps);
    text += row.failure.empty() ? fmt::format("{:>10.4f} {:>+8.2f} %", row.value, 100 * row.error)
                                : fmt::format("{:>20}", row.failure);
    text += fmt::format(" {:>8.3f} {:>9.3f}\n", row.set_up, row.cpu);
  }
  return text;
}

}  // namespace piola
