// SPDX-License-Identifier: Apache-2.0
#include "piola/estimates/case_plan.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/version.hpp"
#include "piola/exec/threads.hpp"
#include "piola/guards/warnings.hpp"
#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace piola {
namespace {

using PlanJson = nlohmann::ordered_json;

/// Trial steps that fail do so in the run, too.
std::string failure_of_trial(Trial const& trial) {
  return fmt::format(
      "trial steps: {} in step {}, at t = {:.4g} s - the run would end there: look at what acts at the start",
      trial.failure->what, trial.steps, trial.time);
}

/// "file:line:column: text" in parts, as far as they are there.
PlanJson warning_json(std::string const& line) {
  PlanJson warning = PlanJson::object();
  auto const number = [&](std::size_t from, std::size_t to, char const* name) {
    int value = 0;
    auto const [end, error] = std::from_chars(line.data() + from, line.data() + to, value);
    bool const good = error == std::errc() && end == line.data() + to;
    if (good) warning[name] = value;
    return good;
  };
  std::size_t const text = line.find(": ");
  std::size_t const column = text == std::string::npos || text == 0 ? std::string::npos : line.rfind(':', text - 1);
  std::size_t const row = column == std::string::npos || column == 0 ? std::string::npos : line.rfind(':', column - 1);
  bool const placed = row != std::string::npos && number(row + 1, column, "line") && number(column + 1, text, "column");
  if (placed) warning["file"] = line.substr(0, row);
  warning["text"] = placed ? line.substr(text + 2) : line;
  return warning;
}

PlanJson bodies_json(CasePlan const& plan) {
  PlanJson bodies = PlanJson::array();
  for (std::size_t b = 0; b < plan.facts.size(); ++b) {
    BodyProperties const& facts = plan.facts[b];
    BodySpec const& body = plan.spec.bodies[b];
    auto const dimension = static_cast<std::size_t>(body.shape.dimension);
    bodies.push_back({{"name", facts.name},
                      {"particles", facts.particles},
                      {"spacing_m", std::vector(facts.spacing.begin(), facts.spacing.begin() + dimension)},
                      {"mass", facts.mass},
                      {"law", body.law},
                      {"formulation", body.formulation.name},
                      {"pressure_wave_m_per_s", facts.p_wave},
                      {"shear_wave_m_per_s", facts.s_wave},
                      {"initial_speed_m_per_s", facts.largest_speed}});
  }
  return bodies;
}

}  // namespace

CasePlan plan_of_case(CaseSpec spec, ParticleSet particles, double reading_seconds) {
  PIOLA_EXPECTS(reading_seconds >= 0);
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  CasePlan plan;
  plan.facts = body_properties(spec, particles);
  // Smaller cases are built, which also detects input errors of the formulation; of larger ones a part.
  if (particles.size() < large_case) {
    CostMeter const meter;
    Simulation simulation = build(std::move(spec), std::move(particles));
    auto const [cost, trial] = estimate(simulation, meter);
    plan.cost = cost;
    plan.warnings = std::move(simulation.warnings);
    if (trial.failure) plan.warnings.push_back(failure_of_trial(trial));
    plan.spec = std::move(simulation.spec);
    plan.particles = std::move(simulation.particles);
  } else {
    int const threads = exec_host::set_threads(spec.run.threads);
    CostMeter const meter;
    Assembly const assembly = assemble(spec, particles);
    reading_seconds += meter.seconds();
    plan.cost = estimate_from_parts(spec, assembly.particles, threads);
    plan.warnings = warnings_of(spec, assembly, {.step = plan.cost.step});
    plan.left_out.push_back(fmt::format(
        "trial steps: with {} particles or more, steps are estimated on a small part of each body", large_case));
    plan.spec = std::move(spec);
    plan.particles = std::move(particles);
  }
  plan.cost.setup_seconds += reading_seconds;
  return plan;
}

std::string plan_json(CasePlan const& plan) {
  Estimate const& cost = plan.cost;
  PlanJson json{{"piola", version()},
                {"title", plan.spec.title},
                {"dimension", plan.particles.dimension},
                {"particles", plan.particles.size()},
                {"end_s", plan.spec.run.end}};
  json["bodies"] = bodies_json(plan);
  json["step"] = {
      {"first_s", std::min(cost.rule.first, cost.step)}, {"settled_s", cost.step}, {"limit", cost.rule.limit}};
  json["steps"] = {{"least", cost.steps}, {"most", cost.most_steps}, {"tried", cost.trial_steps}};
  if (!cost.varies.empty()) json["steps"]["why"] = cost.varies;
  json["threads"] = cost.threads;
  json["set_up_s"] = cost.setup_seconds;
  json["run_s"] = {{"least", cost.run_seconds}, {"most", cost.most_run_seconds}};
  json["memory_bytes"] = cost.memory;
  json["disk_bytes"] = cost.disk;
  json["left_out"] = plan.left_out;
  json["warnings"] = PlanJson::array();
  for (std::string const& warning : plan.warnings) json["warnings"].push_back(warning_json(warning));
  return json.dump(2) + "\n";
}

}  // namespace piola
