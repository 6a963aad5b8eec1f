// SPDX-License-Identifier: Apache-2.0
#include "piola/guards/failure_text.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/output/checkpoint.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola {
namespace {

std::string subject(Failure const& f) {
  if (f.particle < 0) return "the " + f.what;
  return fmt::format("particle {} (body '{}', X = {}, x = {}) {}", f.particle, f.body, point_text(f.X), point_text(f.x),
                     f.what);
}

std::string values_text(Failure const& f) {
  std::string text;
  for (auto const& [name, value] : f.values)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, number_text(value, 4));
  return text;
}

std::string limit_text(TimeState const& m, std::string const& limit) {
  if (m.step == 0) return "no step was done: the initial state itself is not admissible";
  std::string const by = m.bounded_by_max_step ? "run.max_step" : limit;
  return fmt::format("dt = {} at the last step (the first was {}){}{}", quantity_text(m.dt, "s"),
                     quantity_text(m.first_dt, "s"), by.empty() ? "" : ", limited by ", by);
}

std::string usual_causes(Failure const& f, TimeState const& m) {
  if (m.step < 5)
    return "often the initial velocity or deformation is wrong (units, sign), or a material constant is; try 'piola "
           "check'";
  if (f.particle < 0)
    return "often one particle is crushed or far from its neighbours: look at Jacobian and Velocity of the last frame; "
           "a smaller run.cfl or finer particles may help";
  return "often the step is too large (try half of run.cfl), the particles too coarse for the deformation, or the "
         "stabilisation too weak";
}

/// The state of the failure and the newest one before it that was kept.
std::string places_text(std::filesystem::path const& results) {
  auto const kept = list_checkpoints(results);
  return fmt::format("last state: {} and {}; {}", (results / "frames.hdf.series").string(),
                     (results / failed_checkpoint).string(),
                     kept.empty() ? "no checkpoint was kept before it (output.checkpoints); "
                                  : fmt::format("newest checkpoint before it: {}; ", kept.front().string()));
}

}  // namespace

void add_energies(Failure& failure, HistoryTable const& history) {
  bool const named = std::any_of(failure.values.begin(), failure.values.end(),
                                 [](auto const& value) { return value.first.starts_with("total energy"); });
  if (named || history.rows.empty() || !history.find("total_energy")) return;
  auto const energy = history.values("total_energy"), work = history.values("external_work");
  failure.values.emplace_back("energy at the start [J]", energy.front());
  failure.values.emplace_back("total energy [J]", energy.back());
  failure.values.emplace_back("work of loads [J]", work.back());
}

std::string point_text(std::array<double, 3> const& p) {
  return fmt::format("({}, {}, {}) m", number_text(p[0], 4), number_text(p[1], 4), number_text(p[2], 4));
}

std::string failure_text(Failure const& failure, std::string const& causes, TimeState const& moment,
                         std::string const& limit, std::filesystem::path const& results) {
  PIOLA_EXPECTS(moment.step >= 0);
  std::string const values = values_text(failure);
  std::string const likely = causes.empty() ? usual_causes(failure, moment) : causes;
  std::string const where = results.empty() ? "" : places_text(results);
  return fmt::format("stopped at step {}, t = {:.6g} s: {}{}{}\n  {}\n  {}\n  {}see docs/user/when-it-stops.md",
                     moment.step, moment.time, subject(failure), values.empty() ? "" : ", ", values,
                     limit_text(moment, limit), likely, where);
}

}  // namespace piola
