// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/guard_observer.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/error_agreement.hpp"
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
  if (is_on() && comm::rank() == 0) guards_ = make_guards(results_.spec, results_.particles);
  told_.assign(guards_.size(), 0);
  kicked_ = starts_under_pressure(results_.spec);
}

void GuardObserver::observe(Formulation const& formulation, TimeState const& moment) {
  if (!is_on() || (kicked_ && moment.step == 0)) return;
  bool const last = moment.time >= results_.spec.run.end || moment.at_rest;
  auto const step = static_cast<double>(moment.step);
  Diagnostics const* row = history_.row_of(moment.step);
  jump_.observe(formulation, moment, row, last);
  if (row == nullptr && !last && step - last_look_ < look_interval) return;
  last_look_ = step;
  Diagnostics const own = row == nullptr ? formulation.diagnose() : *row;
  scale_.observe(own, moment);
  evaluate_on_root(formulation, results_.particles, [&](FieldCache& fields) {
    evaluate_guards({formulation, moment, own, scale_, fields, last});
  });
  stops_ = comm::of_root(stops_);
}

void GuardObserver::evaluate_guards(GuardInput const& look) {
  for (std::size_t k = 0; k < guards_.size(); ++k) {
    guards_[k]->look(look);
    stops_ = stops_ || guards_[k]->stop_request().has_value();
    if (told_[k] != 0 || look.moment.step == 0 || guards_[k]->words().empty()) continue;
    told_[k] = 1;
    results_.journal.report(fmt::format("so far, at t = {:.6g} s: {}", look.moment.time, guards_[k]->words()));
  }
}

void GuardObserver::finish(Formulation const&, TimeState const&, RunStatus) {
  for (auto const& guard : guards_) {
    if (auto const words = guard->words(); !words.empty()) results_.journal.warn(words);
  }
}

void GuardObserver::save(StateWriter& writer) const {
  if (!is_on()) return;
  std::vector<double> state{last_look_};
  state.insert(state.end(), told_.begin(), told_.end());
  writer.put("guards", state);
  scale_.save(writer);
  jump_.save(writer);
  for (auto const& guard : guards_) guard->save(writer);
}

void GuardObserver::load(NamedState& reader, TimeState const& moment) {
  if (!is_on() || !reader.has("guards")) return;  // checkpoints of older versions have none
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
  if (stops_) return StopRequest{};  // rank 0 has its text
  return std::nullopt;
}

std::optional<std::vector<GuardNumbers>> GuardObserver::report() const {
  if (!is_on()) return std::nullopt;
  std::vector<GuardNumbers> all;
  for (auto const& guard : guards_) {
    if (auto numbers = guard->numbers()) all.push_back(std::move(*numbers));
  }
  return all;
}

}  // namespace piola
