// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/guard_observer.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace piola {
namespace {

/// Steps between checks in a run with few rows of history; a check costs as much as a row, i.e. a few steps.
constexpr double look_interval = 1000;

double finest_spacing(ParticleSet const& particles) {
  double least = std::numeric_limits<double>::infinity();
  for (Body const& body : particles.bodies)
    least = std::min(least, *std::min_element(body.spacing.begin(), body.spacing.begin() + particles.dimension));
  return particles.bodies.empty() ? 0 : least;
}

}  // namespace

GuardObserver::GuardObserver(Results results, double mass, HistoryObserver const& history)
    : results_(std::move(results)),
      history_(history),
      scale_(mass, finest_spacing(results_.particles), roundoff_energy(results_.spec, results_.particles)),
      jump_(results_.spec, results_.particles, scale_) {
  PIOLA_EXPECTS(mass >= 0);
  if (results_.spec.run.guards.on) guards_ = make_guards(results_.spec, results_.particles);
  told_.assign(guards_.size(), 0);
  kicked_ = starts_under_pressure(results_.spec);
}

void GuardObserver::observe(Formulation const& formulation, TimeState const& moment) {
  if (guards_.empty() || (kicked_ && moment.step == 0)) return;
  bool const last = moment.time >= results_.spec.run.end || moment.at_rest;
  auto const step = static_cast<double>(moment.step);
  Diagnostics const* row = history_.row_of(moment.step);
  jump_.observe(formulation, moment, row, last);
  if (row == nullptr && !last && step - last_look_ < look_interval) return;
  last_look_ = step;
  Diagnostics const own = row == nullptr ? formulation.diagnose() : *row;
  scale_.observe(own, moment);
  FieldCache fields(formulation, results_.particles);
  note_shorter_step(formulation.step_estimate(), moment, fields);
  GuardInput const look{formulation, moment, own, scale_, fields, last};
  for (std::size_t k = 0; k < guards_.size(); ++k) {
    guards_[k]->look(look);
    if (told_[k] != 0 || moment.step == 0 || guards_[k]->words().empty()) continue;
    told_[k] = 1;
    results_.journal.report(fmt::format("so far, at t = {:.6g} s: {}", moment.time, guards_[k]->words()));
  }
}

/// Logs what limits the step each time it has halved. Bounds of the next step: those of the last one are gone.
void GuardObserver::note_shorter_step(StepEstimate const& next, TimeState const& moment, FieldCache& fields) {
  if (moment.step == 0 || moment.cut_to_end || moment.bounded_by_max_step) return;
  longest_dt_ = std::max(longest_dt_, moment.dt);
  if (!(moment.dt < 0.5 * std::min(longest_dt_, noted_dt_))) return;
  noted_dt_ = moment.dt;
  std::string const where =
      next.particle < 0
          ? ""
          : ", at " + suspect(fields, static_cast<std::size_t>(next.particle), moment.time).text(results_.particles);
  results_.journal.note(fmt::format("t = {:.6g} s: the step fell to {:.3g} s, limited by {}{}", moment.time, moment.dt,
                                    next.limit, where));
}

void GuardObserver::finish(Formulation const&, TimeState const&, RunStatus) {
  for (auto const& guard : guards_) {
    if (auto const words = guard->words(); !words.empty()) results_.journal.warn(words);
  }
}

void GuardObserver::save(StateWriter& writer) const {
  if (guards_.empty()) return;
  std::vector<double> state{last_look_};
  state.insert(state.end(), told_.begin(), told_.end());
  writer.put("guards", state);
  scale_.save(writer);
  jump_.save(writer);
  for (auto const& guard : guards_) guard->save(writer);
}

void GuardObserver::load(NamedState& reader, TimeState const& moment) {
  if (guards_.empty() || !reader.has("guards")) return;  // checkpoints of older versions have none
  auto const state = reader.all("guards");
  last_look_ = state[0];
  told_.assign(state.begin() + 1, state.end());
  told_.resize(guards_.size(), 0);  // checkpoints of older versions have fewer guards
  scale_.load(reader);
  jump_.load(reader, moment.time);
  for (auto const& guard : guards_) guard->load(reader);
}

std::optional<StopRequest> GuardObserver::stop_request() const {
  if (jump_.stop_request()) return jump_.stop_request();
  for (auto const& guard : guards_) {
    if (auto stop_request = guard->stop_request()) return stop_request;
  }
  return std::nullopt;
}

std::optional<std::vector<GuardNumbers>> GuardObserver::report() const {
  if (guards_.empty()) return std::nullopt;
  std::vector<GuardNumbers> all;
  for (auto const& guard : guards_) {
    if (auto numbers = guard->numbers()) all.push_back(std::move(*numbers));
  }
  return all;
}

}  // namespace piola
