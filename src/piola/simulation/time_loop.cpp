// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/time_loop.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/error_agreement.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace piola {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// A step so small that the run would never end indicates a broken state.
bool collapsed(double stable, RunSpec const& run, TimeState const& moment) {
  double const least = run.min_step > 0 ? run.min_step : 1e-6 * moment.first_dt;
  return !(stable > 0) || !std::isfinite(stable) || stable < least;
}

Failure collapse(double stable) {
  return {.what = "time step collapsed", .body = {}, .X = {}, .x = {}, .values = {{"stable step [s]", stable}}};
}

struct Step {
  double dt;        ///< s
  bool cut_to_end;  ///< a run with a later end would take another one
};

/// The stable step, shortened by the user's bound and to hit the end time exactly. A remainder of less than a millionth
/// of a step is added to the last step.
Step choose_step(double stable, RunSpec const& run, TimeState& moment) {
  moment.bounded_by_max_step = run.max_step < stable;
  double const dt = std::min(stable, run.max_step);
  double const rest = run.end - moment.time;
  if (dt * (1 + 1e-6) < rest) return {dt, false};
  return {rest, rest != dt || moment.time + dt != run.end};
}

/// Takes a step, or an iteration of a relaxation that minimises the energy. Whether the bodies are at rest.
bool advance(Formulation& formulation, double time, double dt, Relaxation* relaxation) {
  if (relaxation != nullptr && relaxation->minimises()) return relaxation->descend(formulation, time, dt);
  formulation.step(time, dt);
  return relaxation != nullptr && relaxation->after_step(formulation, dt);
}

enum Flag : unsigned { stop_asked = 1, wall_time_used = 2, checkpoint_asked = 4, all_flags = 7 };

/// The flags among `wanted` that are set now. steps: see WallLimit::reached().
unsigned flags_now(LoopControl const& control, unsigned wanted, int steps) {
  unsigned flags = 0;
  if (control.stop.load(std::memory_order_relaxed) != 0) flags |= stop_asked;
  if (control.wall.reached(steps)) flags |= wall_time_used;
  if ((wanted & checkpoint_asked) != 0 && control.checkpoint_request != nullptr &&
      control.checkpoint_request->exchange(0) != 0)
    flags |= checkpoint_asked;
  return flags & wanted;
}

/// Before a step on several ranks: rank 0 sends its flags with the sums of the step.
void send_flags(LoopControl const& control) {
  if (comm::is_parallel()) comm::send_flags(comm::rank() == 0 ? flags_now(control, all_flags, 1) : 0);
}
/// After a step: on one rank the flags now, on several ranks those sent before the step.
bool is_set(LoopControl const& control, Flag flag) {
  return ((comm::is_parallel() ? comm::received_flags() : flags_now(control, flag, 0)) & flag) != 0;
}

/// How the loop ends after a step, if it does before the end of the run.
std::optional<LoopResult> end_before_time(LoopControl const& control, TimeState const& moment) {
  if (is_set(control, stop_asked)) return LoopResult{.ending = RunStatus::stopped};
  if (moment.time >= control.pause.time || moment.step >= control.pause.step)
    return LoopResult{.ending = RunStatus::stopped, .paused = true};
  if (is_set(control, wall_time_used)) return LoopResult{.ending = RunStatus::stopped, .out_of_time = true};
  return std::nullopt;
}

/// Shows a step to the observers. The end of the run if one of them objects; those after it, checkpoints among them, do
/// not see the step then and keep it as no good state.
std::optional<LoopResult> show(Formulation& formulation, TimeState const& moment,
                               std::span<Observer* const> observers) {
  for (Observer* observer : observers) {
    observer->observe(formulation, moment);
    if (auto stop_request = observer->stop_request())
      return LoopResult{.ending = RunStatus::failed,
                        .failure = std::move(stop_request->failure),
                        .causes = std::move(stop_request->causes)};
  }
  return {};
}

}  // namespace

LoopResult march(Formulation& formulation, RunSpec const& run, TimeState& moment, std::span<Observer* const> observers,
                 LoopControl const& control, Relaxation* relaxation, StepTraffic* traffic) {
  PIOLA_EXPECTS(moment.step >= 0 && std::isfinite(moment.time));
  auto const start = Clock::now();
  double const wall_before = moment.wall_seconds;
  if (relaxation != nullptr && moment.step == 0) relaxation->start(formulation);
  moment.at_rest = relaxation != nullptr && relaxation->rest().reached;
  while (moment.time < run.end && !moment.at_rest) {
    auto const step_start = Clock::now();
    double const stable = formulation.stable_time_step();
    if (moment.step == 0) moment.first_dt = std::min(stable, run.max_step);
    if (collapsed(stable, run, moment)) return {.ending = RunStatus::failed, .failure = collapse(stable)};

    auto const [dt, cut_to_end] = choose_step(stable, run, moment);
    if (cut_to_end) {
      for (Observer* observer : observers) observer->before_shortened_step(formulation, moment);
    }
    send_flags(control);
    if (traffic != nullptr) traffic->begin_step();
    moment.at_rest = advance(formulation, moment.time, dt, relaxation);
    if (traffic != nullptr) traffic->end_step();

    moment.time = dt == run.end - moment.time ? run.end : moment.time + dt;
    moment.step += 1;
    moment.dt = dt;
    moment.cut_to_end = cut_to_end;
    moment.stepping_seconds += seconds_since(step_start);
    moment.wall_seconds = wall_before + seconds_since(start);

    moment.checkpoint_requested = is_set(control, checkpoint_asked);
    if (auto failure = formulation.failure()) return {.ending = RunStatus::failed, .failure = std::move(failure)};
    if (auto objected = show(formulation, moment, observers)) return std::move(*objected);
    control.wall.step_took(seconds_since(step_start));
    if (moment.time >= run.end || moment.at_rest) continue;
    if (auto ended = end_before_time(control, moment)) return std::move(*ended);
  }
  return {};
}

}  // namespace piola
