// SPDX-License-Identifier: Apache-2.0
#include "run_support.hpp"
#include "piola/base/problems.hpp"
#include "piola/base/text.hpp"
#include "commands.hpp"
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fmt/format.h>
#include <unistd.h>

namespace piola::app {
namespace {

static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

std::atomic<long> second_of_first_signal{0};

/// Tools that stop programs often signal twice, the process and its group: only a signal that comes later means
/// impatience.
extern "C" void on_stop_signal(int signal) {
  constexpr long patience = 2;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (stop_signal.exchange(signal) == 0)
    second_of_first_signal = now.tv_sec;
  else if (now.tv_sec - second_of_first_signal >= patience)
    std::_Exit(128 + signal);
}

std::string percent(double share) { return fmt::format("{:3.0f} %", 100 * std::clamp(share, 0.0, 1.0)); }

std::string rate_text(double stages_per_second) { return fmt::format("{:.2f} M stages/s", stages_per_second / 1e6); }

std::string progress_line(Progress const& p) {
  return fmt::format("{}  t = {} of {}  step {}  dt = {}  energy {}  {}  {} left", percent(p.moment.time / p.end),
                     quantity_text(p.moment.time, "s"), quantity_text(p.end, "s"), count_text(p.moment.step),
                     quantity_text(p.moment.dt, "s", 3), quantity_text(p.total_energy, "J"),
                     rate_text(p.stages_per_second), duration_text(p.seconds_left));
}

std::string body_line(Body const& body, BodySpec const& spec, int dimension) {
  auto const [least, most] = std::minmax_element(body.spacing.begin(), body.spacing.begin() + dimension);
  double const finest = *least, coarsest = *most;
  std::string const text = finest == coarsest
                               ? quantity_text(finest, "m")
                               : fmt::format("{} to {}", quantity_text(finest, "m"), quantity_text(coarsest, "m"));
  return fmt::format("  {}: {} particles, spacing {}, {}\n", body.name, count_text(body.last - body.first), text,
                     spec.law);
}

}  // namespace

std::atomic<int> stop_signal{0};

void catch_stop_signals() {
  std::signal(SIGINT, on_stop_signal);
  std::signal(SIGTERM, on_stop_signal);
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is then an ordinary write error with a message
}

Console::Console(bool quiet)
    : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) != 0), last_(std::chrono::steady_clock::now()) {}
Console::~Console() { clear(); }

void Console::clear() {
  if (shown_ > 0) fmt::print(stderr, "\r{:{}}\r", "", shown_);
  shown_ = 0;
}

void Console::progress(Progress const& progress) {
  if (quiet_) return;
  std::string const line = progress_line(progress);
  if (terminal_) {
    fmt::print(stderr, "\r{:<{}}", line, shown_);
    std::fflush(stderr);
    shown_ = std::max(shown_, line.size());
    return;
  }
  auto const now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::seconds(10)) return;
  last_ = now;
  fmt::print(stderr, "{}\n", line);
}

void Console::warning(std::string const& text) {
  clear();
  fmt::print(stderr, "warning: {}\n", text);
}

std::string start_report(Simulation const& s, std::filesystem::path const& folder) {
  std::string text =
      fmt::format("{}\n{} in {}D, {} particles, {} thread{}\n", s.spec.title, s.formulation_name, s.particles.dimension,
                  count_text(s.particles.size()), s.threads, s.threads == 1 ? "" : "s");
  for (std::size_t b = 0; b < s.spec.bodies.size() && b < s.particles.bodies.size(); ++b)
    text += body_line(s.particles.bodies[b], s.spec.bodies[b], s.particles.dimension);
  text += fmt::format("  first step {}, end {}\n  results in {}\n",
                      quantity_text(s.formulation->stable_time_step(), "s", 3), quantity_text(s.spec.run.end, "s"),
                      folder.string());
  return text;
}

std::string end_report(CaseOutcome const& outcome, std::filesystem::path const& folder) {
  Summary const& s = outcome.summary;
  std::string text =
      fmt::format("{} at t = {} after {} steps, {} of wall time, {}\n", s.status, quantity_text(s.end_time, "s"),
                  count_text(s.steps), duration_text(s.wall_seconds), rate_text(s.stages_per_second));
  text += fmt::format("  energy: {} at start, {} at end, largest rise {:.2g} of it\n",
                      quantity_text(s.energy_initial, "J"), quantity_text(s.energy_final, "J"), s.energy_max_increase);
  if (s.linear_drift && s.angular_drift)
    text += fmt::format("  momentum drift: linear {:.2g}, angular {:.2g} of its scale\n", *s.linear_drift,
                        *s.angular_drift);
  for (MeasuredQuantity const& q : s.quantities)
    text += fmt::format("  {} = {}{}\n", q.name, number_text(q.value), q.unit == "1" ? "" : " " + q.unit);
  if (!s.warnings.empty())
    text += fmt::format(
        "  {}: see log.txt\n",
        s.warnings.size() == 1 ? "1 warning" : count_text(static_cast<std::int64_t>(s.warnings.size())) + " warnings");
  if (!outcome.last_picture.empty()) text += fmt::format("  picture: {}\n", outcome.last_picture.string());
  if (!outcome.index.empty()) text += fmt::format("  for ParaView: {}\n", outcome.index.string());
  if (outcome.ending == Ending::stopped)
    text += fmt::format("  a checkpoint was written; continue with: piola resume {}\n", folder.string());
  return text;
}

int run_and_report(Simulation& simulation, RunOptions const& options, bool quiet) {
  catch_stop_signals();
  if (!quiet) fmt::print("{}", start_report(simulation, options.folder));
  std::fflush(stdout);
  Console console(quiet);
  CaseOutcome const outcome = run_case(simulation, options, console, stop_signal);
  console.clear();
  if (!quiet) fmt::print("{}", end_report(outcome, options.folder));
  std::fflush(stdout);
  if (outcome.ending == Ending::failed) fmt::print(stderr, "piola: {}\n", outcome.failure);
  switch (outcome.ending) {
    case Ending::failed: return physics_failed;
    case Ending::stopped: return stopped_by_signal;
    default: return completed;
  }
}

std::filesystem::path case_file(std::filesystem::path const& given) {
  std::filesystem::path const file = std::filesystem::is_directory(given) ? given / "case.toml" : given;
  if (!std::filesystem::exists(file))
    throw InputError(fmt::format("{}: there is no such case file - check the path", file.string()));
  return file;
}

}  // namespace piola::app
