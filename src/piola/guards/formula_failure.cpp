// SPDX-License-Identifier: Apache-2.0
#include "piola/guards/formula_failure.hpp"
#include "piola/base/text.hpp"
#include "piola/model/body_properties.hpp"
#include "piola/model/case_particles.hpp"
#include "piola/model/region_checks.hpp"
#include <cmath>
#include <fmt/format.h>

namespace piola {
namespace {

using Components = std::array<Expression, 3>;

/// Formulas of one section of the case, with their targets.
struct ActingFormulas {
  std::string owner;  ///< load on body "bar": pressure
  Components const& formulas;
  double until;  ///< [s]
  LoadSpec const* load = nullptr;
  SupportSpec const* support = nullptr;  ///< without load and support: a rigid shape
};

/// The particles at which the formulas are evaluated.
std::vector<std::int64_t> targets_of(ActingFormulas const& acting, ParticleSet const& particles) {
  if (acting.load != nullptr)
    return loaded_particles(particles, *body_named(particles, acting.load->body), *acting.load);
  if (acting.support != nullptr)
    return supported_particles(particles, *body_named(particles, acting.support->body), *acting.support);
  return {0};
}

std::optional<Failure> first_failure(ActingFormulas const& acting, ParticleSet const& particles,
                                     TimeState const& moment) {
  auto const ids = targets_of(acting, particles);
  for (double const part : {-1.0, -0.5, 0.0, 1.0}) {  // times of evaluation within a step
    double const t = std::max(0.0, moment.time + part * moment.dt);
    if (t > acting.until) continue;
    for (Expression const& formula : acting.formulas) {
      if (!formula.holds_anywhere()) continue;
      for (std::int64_t const id : ids) {
        auto const& X = particles.X[static_cast<std::size_t>(id)];
        double const value = formula(X, t);
        if (std::isfinite(value)) continue;
        Failure failure;
        failure.what =
            fmt::format("{} = {} is {} at t = {:.6g} s, X = {}", acting.owner, in_quotes(formula.text()),
                        std::isnan(value) ? "not a number" : "infinite", t, point_text(X, particles.dimension));
        return failure;
      }
    }
  }
  return std::nullopt;
}

/// All formulas that act during a run.
std::vector<ActingFormulas> acting_formulas(CaseSpec const& spec) {
  constexpr double always = std::numeric_limits<double>::infinity();
  std::vector<ActingFormulas> all;
  for (LoadSpec const& load : spec.loads)
    all.push_back({"load on body " + in_quotes(load.body) + ": " + load.value_key(), load.value, load.until, &load});
  for (SupportSpec const& support : spec.supports)
    if (support.velocity)
      all.push_back({"support of body " + in_quotes(support.body) + ": velocity", *support.velocity, support.until,
                     nullptr, &support});
  for (RigidSpec const& rigid : spec.rigids)
    for (auto const& [key, formulas] :
         {std::pair{"velocity", &rigid.velocity}, std::pair{"angular_velocity", &rigid.angular_velocity},
          std::pair{"gravity", &rigid.gravity}, std::pair{"force", &rigid.force}, std::pair{"torque", &rigid.torque}})
      all.push_back({"rigid shape " + in_quotes(rigid.name) + ": " + key, *formulas, always});
  return all;
}

}  // namespace

std::optional<Failure> failure_of_formula(CaseSpec const& spec, ParticleSet const& particles, TimeState const& moment) {
  for (ActingFormulas const& acting : acting_formulas(spec))
    if (auto failure = first_failure(acting, particles, moment)) return failure;
  return std::nullopt;
}

std::vector<std::string> notes_of_tables(CaseSpec const& spec) {
  std::vector<std::string> notes;
  for (ActingFormulas const& acting : acting_formulas(spec))
    for (Expression const& value : acting.formulas)
      if (!value.is_formula() && value.holds_anywhere()) notes.push_back(acting.owner + ": " + value.text());
  return notes;
}

}  // namespace piola
