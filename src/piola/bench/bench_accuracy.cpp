// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench_accuracy.hpp"
#include "piola/base/errors.hpp"
#include "piola/bench/bench_columns.hpp"
#include "piola/bench/bench_support.hpp"
#include "piola/exec/backend_registry.hpp"
#include "piola/formulations/make_formulation.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/measures/probe.hpp"
#include "piola/measures/quantities.hpp"
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

namespace piola {
namespace {

struct Problem {
  char const* name;
  Column column;
  double poissons_ratio;
  double reference;  ///< bench/finite_elements/README.md, in `unit`
  double unit;       ///< SI value of the unit of `reference`
  double end;        ///< just after the peak [s]
  double every;      ///< sampling interval [s]
};

constexpr double degrees = std::numbers::pi / 180;
constexpr Problem studies[] = {{"twist", Column::twisting, 0.45, 337.5, degrees, 0.12, 5e-4},
                               {"twist", Column::twisting, 0.499, 342.7, degrees, 0.12, 5e-4},
                               {"bend", Column::bending, 0.45, 2.997, 1, 0.5, 5e-3},
                               {"bend", Column::bending, 0.499, 2.987, 1, 0.5, 5e-3}};

struct Scheme {
  char const* name;
  char const* formulation;
  char const* scheme;  ///< nullptr: the default
};

constexpr Scheme compared[] = {
    {"nodal", "nodal", nullptr}, {"jst_sph", "jst_sph", nullptr}, {"jst_sph paper", "jst_sph", "paper"}};

ProbeSpec probe_of(Problem const& problem) {
  ProbeSpec spec;
  spec.name = "top";
  spec.body = "column";
  spec.where = Expression("Y > 5.999999");
  bool const twisting = problem.column == Column::twisting;
  spec.kind = twisting ? ProbeSpec::Kind::twist : ProbeSpec::Kind::average;
  spec.axis = 1;
  spec.quantities = {twisting ? "twist_angle" : "displacement_x"};
  return spec;
}

/// Steps to the end of the problem; evaluates the probe and the clock.
void run(Formulation& formulation, ParticleSet const& particles, Problem const& problem, AccuracyRow& row) {
  Probe probe(probe_of(problem), particles);
  std::vector<double> times, values;
  auto const look = [&](double time) {
    FieldCache cache(formulation, particles);
    times.push_back(time);
    values.push_back(probe.evaluate(cache, time).front());
  };
  look(0);
  double time = 0;
  while (time < problem.end) {
    double const next = problem.every * (std::floor(time / problem.every) + 1);  // a step may be longer
    double const start = cpu_seconds();
    for (; time < next && row.failure.empty(); ++row.steps) {
      double const dt = formulation.stable_time_step();
      if (!(dt > 0)) row.failure = "the time step collapsed";
      formulation.step(time, dt);
      time += dt;
      if (auto const failure = formulation.failure()) row.failure = fmt::format("a particle {}", failure->what);
    }
    row.cpu += cpu_seconds() - start;
    if (!row.failure.empty()) return;
    look(time);
  }
  auto const peak = first_peak(times, values);
  if (!peak || !std::isfinite(peak->value)) {
    row.failure = "no peak";
    return;
  }
  row.value = std::abs(peak->value) / problem.unit;
  row.error = row.value / problem.reference - 1;
}

AccuracyRow measure(Problem const& problem, Scheme const& scheme, int across, std::string const& backend) {
  double const none = std::numeric_limits<double>::quiet_NaN();
  AccuracyRow row{.problem = problem.name,
                  .poissons_ratio = problem.poissons_ratio,
                  .formulation = scheme.name,
                  .across = across,
                  .value = none,
                  .error = none,
                  .failure = {}};
  FormulationSpec formulation{scheme.formulation, {}, {}};
  if (scheme.scheme != nullptr) formulation.words["scheme"] = scheme.scheme;
  Assembly const assembly = column(problem.column, {across, 6 * (across - 1) + 1, across},
                                   rubber(problem.poissons_ratio), formulation, backend);
  row.particles = static_cast<long>(assembly.particles.size());
  double const start = cpu_seconds();
  auto const solver = make_formulation(assembly);
  row.set_up = row.cpu = cpu_seconds() - start;
  run(*solver, assembly.particles, problem, row);
  return row;
}

struct CostAtAccuracy {
  double error;
  char const* text;
};

/// Processor time of the coarsest run from which on a scheme stays within an error; nan: it does not.
double price(AccuracyReport const& report, AccuracyRow const& of, double error) {
  double cpu = std::numeric_limits<double>::quiet_NaN();
  for (auto const& row : report.rows) {
    if (row.problem != of.problem || row.poissons_ratio != of.poissons_ratio || row.formulation != of.formulation)
      continue;
    bool const within = std::abs(row.error) <= error;
    if (!within)
      cpu = std::numeric_limits<double>::quiet_NaN();
    else if (std::isnan(cpu))
      cpu = row.cpu;
  }
  return cpu;
}

constexpr CostAtAccuracy prices[] = {{0.03, "3 %"}, {0.01, "1 %"}, {0.003, "0.3 %"}};

std::string prices_text(AccuracyReport const& report) {
  std::string text =
      fmt::format("\nprocessor time from which on the error stays below [s]\n{:<6} {:>6} {:<16}", "", "nu", "");
  for (auto const& p : prices) text += fmt::format(" {:>8}", p.text);
  text += "\n";
  AccuracyRow const* last = nullptr;
  for (auto const& row : report.rows) {
    bool const same = last != nullptr && last->problem == row.problem && last->poissons_ratio == row.poissons_ratio &&
                      last->formulation == row.formulation;
    last = &row;
    if (same) continue;
    text += fmt::format("{:<6} {:>6} {:<16}", row.problem, row.poissons_ratio, row.formulation);
    for (auto const& p : prices) {
      double const cpu = price(report, row, p.error);
      text += std::isnan(cpu) ? fmt::format(" {:>8}", "-") : fmt::format(" {:>8.3f}", cpu);
    }
    text += "\n";
  }
  return text;
}

}  // namespace

AccuracyReport bench_accuracy(AccuracyOptions const& options) {
  nodal::Backend const* const backend = &nodal::choose_backend(options.backend.c_str());
  AccuracyReport report;
  report.backend = backend->name;
  pin_to(1);
  for (auto const& problem : studies)
    for (auto const& scheme : compared)
      for (int const across : options.across) {
        report.rows.push_back(measure(problem, scheme, across, report.backend));
        if (report.rows.back().cpu > options.longest) break;
      }
  return report;
}

std::string to_json(AccuracyReport const& report) {
  nlohmann::ordered_json j;
  j["machine"] = report.backend;
  for (auto const& row : report.rows) {
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

std::string to_text(AccuracyReport const& report) {
  std::string text = fmt::format(
      "errors against processor time, machine {}, one thread; first peak against converged finite elements\n"
      "{:<6} {:>6} {:<16} {:>6} {:>9} {:>7} {:>10} {:>9} {:>9} {:>9}\n",
      report.backend, "", "nu", "", "across", "particles", "steps", "value", "error", "set-up s", "cpu s");
  for (auto const& row : report.rows) {
    text += fmt::format("{:<6} {:>6} {:<16} {:>6} {:>9} {:>7} ", row.problem, row.poissons_ratio, row.formulation,
                        row.across, row.particles, row.steps);
    text += row.failure.empty() ? fmt::format("{:>10.4f} {:>+8.2f} %", row.value, 100 * row.error)
                                : fmt::format("{:>20}", row.failure);
    text += fmt::format(" {:>8.3f} {:>9.3f}\n", row.set_up, row.cpu);
  }
  return text + prices_text(report);
}

}  // namespace piola
