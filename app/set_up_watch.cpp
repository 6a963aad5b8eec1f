// SPDX-License-Identifier: Apache-2.0
#include "set_up_watch.hpp"
#include "piola/base/stopped.hpp"
#include "piola/base/text.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/model/read_case.hpp"
#include "commands.hpp"
#include "signals.hpp"
#include "streams.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <unistd.h>

namespace piola::app {
namespace {

double seconds_between(SetUpWatch::Clock::time_point from, SetUpWatch::Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// Why set-up ends, in words.
std::string_view cause() { return stop_signal != 0 ? "by a signal" : "because the wall time is used up"; }

}  // namespace

SetUpWatch::SetUpWatch(std::string stage, Limits const& limits)
    : limits_(limits),
      wall_(limits.wall_time, program_start),
      terminal_(::isatty(STDERR_FILENO) != 0),
      stage_(std::move(stage)),
      stage_began_(Clock::now()) {
  thread_ = std::thread([this] { watch(); });
}

SetUpWatch::~SetUpWatch() {
  {
    std::lock_guard const lock(mutex_);
    over_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void SetUpWatch::enter(std::string stage) {
  std::lock_guard const lock(mutex_);
  if (stop_signal != 0) throw SetUpStopped(fmt::format("set-up was stopped {} before {}", cause(), stage));
  stage_ = std::move(stage);
  stage_began_ = Clock::now();
  slowest_sweep_ = 0;
  line_.clear();
}

AfterSweep SetUpWatch::operator()(std::string const& body, double done) {
  std::lock_guard const lock(mutex_);
  auto const now = Clock::now();
  if (slowest_sweep_ == 0 || body != body_) {
    body_ = body;
    packing_began_ = last_sweep_ = now;
    line_.clear();
  }
  slowest_sweep_ = std::max({slowest_sweep_, seconds_between(last_sweep_, now), 1e-6});
  last_sweep_ = now;
  // The reserve is 1.5 times this: time for the next sweep and for storing the packing.
  wall_.step_took(2 * slowest_sweep_);
  double const spent = seconds_between(packing_began_, now);
  if (!limits_.quiet && spent >= 2)
    line_.show(
        fmt::format("packing {}: {:.0f} %, {} left", body, 100 * done, duration_text(spent * (1 - done) / done)));
  bool const ends = stop_signal != 0 || wall_.reached();
  if (ends && comm::rank() == 0) return AfterSweep::keep;  // it ends the other ranks
  if (!(spent > limits_.most_packing)) return AfterSweep::go_on;
  double const left = spent * (1 - done) / done;
  seconds_left_out_ += left;
  left_out_.push_back(
      fmt::format("the packing of body {}: it was taken after {:.2g} % of the sweeps, the others would take "
                  "{} more; its particles, and what is counted by place, are nearly right",
                  in_quotes(body), 100 * done, duration_text(left)));
  return AfterSweep::take;
}

bool SetUpWatch::packs() const {
  constexpr double sweeps = 3, least = 2;  // s
  return slowest_sweep_ > 0 && seconds_between(last_sweep_, Clock::now()) < std::max(least, sweeps * slowest_sweep_);
}

void SetUpWatch::end_if_due() {
  // A packing ends after a sweep, in good time before the wall-time limit. Other stages have a few seconds in any case,
  // so that a run takes at least one step however short its wall time is.
  constexpr double last_moment = 0.1, least = 5;  // s
  double const elapsed = seconds_between(program_start, Clock::now());
  bool const late = wall_.exists() && elapsed >= std::max(least, 0.995 * limits_.wall_time - last_moment);
  bool const asked = stop_signal != 0 && !packs();
  if (!(late || asked) || comm::rank() != 0) return;
  line_.clear();
  // A rank that stops the run prints the reason. The launcher then sends signals to the remaining ranks.
  bool const launcher_may_have_sent_it = !late && comm::is_parallel();
  if (!launcher_may_have_sent_it)
    print_message(
        "piola: set-up was stopped {} while {} ({} after the start); there is nothing to continue from - {}\n", cause(),
        stage_, duration_text(elapsed),
        late ? "give more time, or choose fewer particles" : "start the same command again");
  if (comm::is_parallel()) comm::abort_all(stopped_by_signal);
  ::_exit(stopped_by_signal);
}

void SetUpWatch::say_stage() {
  constexpr double first = 3;  // s
  double const waited = seconds_between(stage_began_, Clock::now());
  if (terminal_ && !limits_.quiet && slowest_sweep_ == 0 && waited >= first)
    line_.show(fmt::format("{}: {} so far", stage_, duration_text(std::floor(waited))));
}

void SetUpWatch::watch() {
  constexpr std::chrono::milliseconds turn{100};
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, turn, [&] { return over_; })) {
    end_if_due();
    say_stage();
  }
}

Simulation set_up(SetUpFrom const& from, SetUpWatch::Limits const& limits) {
  if (comm::rank() == 0) catch_stop_signals();
  SetUpWatch watch("reading the case and making its particles", limits);
  ParticleSet particles;
  CaseSpec spec =
      read_case(from.file, from.overrides,
                {.of_results = from.of_results, .packing = std::ref(watch), .unfinished = from.unfinished}, &particles);
  if (!from.pictures) spec.output.pictures.every = 0;
  watch.enter(fmt::format("building the simulation of {} particles", count_text(particles.size())));
  return build(std::move(spec), std::move(particles));
}

}  // namespace piola::app
