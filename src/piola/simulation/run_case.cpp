// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/run_case.hpp"
#include "piola/base/problems.hpp"
#include "piola/base/text.hpp"
#include "piola/base/version.hpp"
#include "piola/exec/instruction_sets.hpp"
#include "piola/input/case_difference.hpp"
#include "piola/input/case_files.hpp"
#include "piola/output/files.hpp"
#include "piola/output/folder_lock.hpp"
#include "piola/simulation/failure_text.hpp"
#include "piola/simulation/guard_observer.hpp"
#include "piola/simulation/observers.hpp"
#include "piola/simulation/picture_observer.hpp"
#include "piola/simulation/quantities.hpp"
#include "piola/simulation/relaxation.hpp"
#include "piola/simulation/results_folder.hpp"
#include "piola/simulation/run.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace piola {
namespace {

/// All observers of a run, in the order in which they look.
struct Watch {
  HistoryObserver history;
  GuardObserver guards;
  FrameObserver frames;
  PictureObserver pictures;
  Relaxation relaxation;
  CheckpointObserver checkpoints;
  ProgressObserver progress;

  Observer* also;

  Watch(Results const& results, double mass, Listener& listener, CheckpointOrders const& orders, Observer* last)
      : history(results),
        guards(results, mass, history),
        frames(results),
        pictures(results),
        relaxation(results.spec.run),
        checkpoints(results, {&history, &guards, &frames, &pictures, &relaxation}, orders),
        progress(listener, results.spec.run.end, results.particles.size(), history),
        also(last) {}
  std::vector<Observer*> all() {
    std::vector<Observer*> list{&history, &guards, &frames, &pictures, &relaxation, &checkpoints, &progress};
    if (also != nullptr) list.push_back(also);
    return list;
  }
};

std::string start_text(Simulation const& s) {
  return fmt::format("formulation {}, {} particles, {} thread(s), machine {}, end {}", s.formulation_name,
                     count_text(s.particles.size()), s.threads, s.spec.run.machine, quantity_text(s.spec.run.end, "s"));
}

/// Copies of the files that the case names, without which it could not be resumed elsewhere.
void keep_files(CaseSpec const& spec, std::filesystem::path const& folder, Journal& journal) {
  constexpr std::uintmax_t most = 50'000'000;
  namespace fs = std::filesystem;
  for (BodySpec const& body : spec.bodies)
    for (CaseFile const& file : body.shape.files) {
      fs::path const to = folder / kept_files / kept_name(file.given);
      std::error_code error;
      if (fs::equivalent(file.path, to, error)) continue;
      if (fs::file_size(file.path, error) > most) {
        journal.warn(
            fmt::format("{} is larger than 50 MB and is not copied to the results: a resumed run reads it from "
                        "{}",
                        file.given, file.path.string()));
        continue;
      }
      fs::create_directories(folder / kept_files, error);
      if (!fs::copy_file(file.path, to, fs::copy_options::overwrite_existing, error))
        journal.warn(fmt::format("{} could not be copied to {}: {}", file.given, to.string(), error.message()));
    }
}

/// A new run: the folder is emptied of older results, the case is kept as run, the first state is looked at.
Moment begin_new(Simulation& s, RunOptions const& options, Journal& journal, Watch& watch) {
  journal.note(start_text(s));
  write_whole_file(options.folder / "case.toml", s.spec.source);
  keep_files(s.spec, options.folder, journal);
  watch.history.open(*s.formulation, {});
  Moment const moment;
  for (Observer* observer : watch.all()) observer->see(*s.formulation, moment);
  return moment;
}

/// What makes the bits of a resumed run differ from those of an uninterrupted one.
void compare_origin(Checkpoint const& c, Simulation const& s, Journal& journal) {
  std::string const here = exec_host::machine_text(s.spec.run.machine);
  char const* const what = "the numbers may differ in their last digits from those of a run without interruption";
  if (c.version != version())
    journal.warn(fmt::format("the checkpoint was written by Piola {}, this is {}; {}", c.version, version(), what));
  if (c.machine != here)
    journal.warn(
        fmt::format("the checkpoint was written with the instruction set {}, this is {}; {}", c.machine, here, what));
}

/// What the case says differently from the one that the checkpoint was written with, as lines for the log. Throws
/// InputError if any of that would make it another run.
std::vector<std::string> accepted_changes(Checkpoint const& c, CaseSpec const& spec,
                                          std::filesystem::path const& folder) {
  std::string const file = (folder / "case.toml").string();
  std::vector<std::string> accepted;
  std::string refused;
  for (CaseDifference const& d : case_differences(c.source, spec.source)) {
    std::string const line = fmt::format("{}: {} -> {}", d.key, d.before, d.after);
    if (may_change_on_resume(d.key))
      accepted.push_back(line);
    else
      refused += "\n  " + line;
  }
  if (!refused.empty()) {
    throw InputError(
        fmt::format("{}: is not the case that this run was started with (allowed to change: {}) - restore "
                    "it, or run it anew with 'piola run'; what differs:{}",
                    file, keys_that_may_change(), refused));
  }
  if (spec.run.end < c.time) {
    throw InputError(
        fmt::format("{}: run.end = {} s lies before the newest checkpoint (allowed: from {} s on) - give a "
                    "later one",
                    file, spec.run.end, c.time));
  }
  return accepted;
}

/// Brings everything to the newest good checkpoint. One that was reached by a step cut to an earlier end of the run is
/// taken only if `cut_too`.
std::optional<Moment> restore(Simulation& s, std::filesystem::path const& folder, Journal& journal, Watch& watch,
                              bool cut_too) {
  std::vector<std::string> warnings, changes;
  std::vector<std::filesystem::path> abandoned;
  Moment moment;
  bool const found = use_newest_checkpoint(folder, warnings, [&](Checkpoint& c) {
    changes = accepted_changes(c, s.spec, folder);
    if (c.cut_to_end && c.time < s.spec.run.end && !cut_too) {
      abandoned.push_back(checkpoint_path(folder, c.step));
      return false;
    }
    moment = {.time = c.time,
              .step = c.step,
              .dt = c.dt,
              .first_dt = c.first_dt,
              .cut_to_end = c.cut_to_end,
              .wall_seconds = c.wall_seconds,
              .stepping_seconds = c.stepping_seconds};
    s.formulation->load(c.state);
    for (Observer* observer : watch.all()) observer->load(c.observers, moment);
    compare_origin(c, s, journal);
    return true;
  });
  if (!found) return std::nullopt;
  std::error_code kept_all_the_same;
  for (auto const& path : abandoned) std::filesystem::remove(path, kept_all_the_same);
  for (std::string const& warning : warnings) journal.warn(warning);
  for (std::string const& change : changes) journal.note("changed: " + change);
  return moment;
}

/// Bytes of what a formulation saves.
std::int64_t size_of_state(Formulation const& formulation) {
  struct Counter : StateWriter {
    std::int64_t bytes = 0;
    void put(std::string_view, std::span<double const> values) override {
      bytes += static_cast<std::int64_t>(values.size_bytes());
    }
  } counter;
  formulation.save(counter);
  return counter.bytes;
}

/// A resumed run: everything as it was when the newest good checkpoint was written, but for the changes that the user
/// wants and that leave the state at each time as it is.
Moment begin_again(Simulation& s, RunOptions const& options, Journal& journal, Watch& watch) {
  auto moment = restore(s, options.folder, journal, watch, false);
  if (!moment) {
    moment = restore(s, options.folder, journal, watch, true);
    journal.warn(
        fmt::format("the step before t = {} s was cut to the end that the run had then, and no checkpoint from "
                    "before it is left; from there on the numbers differ in their last digits from those of a "
                    "run with the new end from the start",
                    moment->time));
  }
  auto const file = options.folder / "case.toml";
  if (read_text_file(file) != s.spec.source) write_whole_file(file, s.spec.source);
  journal.note(fmt::format("resumed at step {}, t = {} s; {}", moment->step, moment->time, start_text(s)));
  watch.history.open(*s.formulation, moment->time);
  return *moment;
}

double largest(std::vector<double> const& values) {
  double most = 0;
  for (double v : values) most = std::max(most, std::isfinite(v) ? std::abs(v) : 0.0);
  return most;
}

/// Largest rise (sign 1) or fall (sign -1) of the energy that no support or load brought, by the largest energy.
double largest_rise(HistoryTable const& history, double sign) {
  auto const energy = history.values("total_energy"), work = history.values("external_work");
  double rise = 0, lowest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < energy.size(); ++k) {
    double const own = sign * (energy[k] - work[k]);
    if (!std::isfinite(own)) continue;
    lowest = std::min(lowest, own);
    rise = std::max(rise, own - lowest);
  }
  double const scale = largest(energy);
  return scale > 0 ? rise / scale : rise;
}

/// Largest change of a vector column triple since the first row.
double drift(HistoryTable const& history, std::string const& name) {
  double most = 0;
  auto const x = history.values(name + "_x"), y = history.values(name + "_y"), z = history.values(name + "_z");
  for (std::size_t k = 0; k < x.size(); ++k) {
    double const d = std::hypot(x[k] - x[0], y[k] - y[0], z[k] - z[0]);
    if (std::isfinite(d)) most = std::max(most, d);
  }
  return most;
}

/// Half the diagonal of the box around the particles [m]: the arm of the angular momentum scale.
double half_diagonal(ParticleSet const& particles) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    auto const [low, high] = std::minmax_element(particles.X.begin(), particles.X.end(),
                                                 [c](auto const& a, auto const& b) { return a[c] < b[c]; });
    if (low != particles.X.end()) sum += ((*high)[c] - (*low)[c]) * ((*high)[c] - (*low)[c]);
  }
  return std::sqrt(sum) / 2;
}

/// Whether nothing but bodies and other shapes act on a rigid shape.
bool is_left_alone(RigidSpec const& rigid) {
  bool const weightless = std::all_of(rigid.gravity.begin(), rigid.gravity.end(),
                                      [](Expression const& component) { return component.text() == "0"; });
  return rigid.free && weightless && rigid.can_turn && rigid.held == std::array<bool, 3>{};
}

void add_conservation(Summary& summary, HistoryTable const& history, Simulation const& s) {
  if (history.rows.empty()) return;
  auto const energy = history.values("total_energy");
  summary.energy_initial = energy.front();
  summary.energy_final = energy.back();
  summary.energy_max_increase = energy_increase(history);
  summary.energy_max_decrease = energy_decrease(history);
  bool const free = s.spec.supports.empty() && s.spec.loads.empty() && s.spec.mirrors.empty() &&
                    std::all_of(s.spec.rigids.begin(), s.spec.rigids.end(), is_left_alone);
  if (!free) return;
  // sqrt(2 M E_kin) is the momentum of the whole mass at the root mean square speed.
  double const momentum = std::sqrt(2 * s.mass * largest(history.values("kinetic_energy")));
  double const arm = half_diagonal(s.particles);
  summary.linear_drift = momentum > 0 ? drift(history, "linear_momentum") / momentum : 0;
  summary.angular_drift = momentum > 0 && arm > 0 ? drift(history, "angular_momentum") / (momentum * arm) : 0;
}

std::string status_word(Ending ending) {
  switch (ending) {
    case Ending::completed: return "completed";
    case Ending::failed: return "failed";
    default: return "stopped";
  }
}

Summary summarise(Simulation const& s, Moment const& moment, Ending ending, HistoryTable const& history,
                  Journal& journal) {
  Summary summary;
  summary.status = status_word(ending);
  summary.title = s.spec.title;
  summary.version = version();
  summary.formulation = s.formulation_name;
  summary.particles = s.particles.size();
  summary.steps = moment.step;
  summary.end_time = moment.time;
  summary.wall_seconds = moment.wall_seconds;
  summary.threads = s.threads;
  double const stages =
      static_cast<double>(moment.step) * s.formulation->stages_per_step() * static_cast<double>(summary.particles);
  summary.stages_per_second = moment.stepping_seconds > 0 ? stages / moment.stepping_seconds : 0;
  summary.seconds = s.formulation->costs();
  add_conservation(summary, history, s);
  for (QuantitySpec const& spec : s.spec.quantities) {
    std::string why;
    if (auto const value = measure(spec, history, why)) summary.quantities.push_back(*value);
    if (!why.empty() && ending == Ending::completed) journal.warn(why);
  }
  summary.warnings = journal.warnings();
  return summary;
}

}  // namespace

double energy_increase(HistoryTable const& history) { return largest_rise(history, 1); }
double energy_decrease(HistoryTable const& history) { return largest_rise(history, -1); }

namespace {

/// Says whether a dynamic relaxation came to rest.
void report_rest(Simulation const& s, Relaxation const& relaxation, Ending ending, Journal& journal) {
  if (!relaxation.active() || ending != Ending::completed) return;
  Rest const& rest = relaxation.rest();
  std::string const share =
      fmt::format("forces out of balance are {:.2g} of the largest (limit {})", rest.residual, s.spec.run.rest);
  if (rest.reached)
    journal.note(fmt::format("at rest after {} stops: {}", rest.stops, share));
  else
    journal.warn(
        fmt::format("relax: not at rest at run.end after {} stops: {} - give the run more time, or check that "
                    "supports hold every body",
                    rest.stops, share));
}

}  // namespace

CaseOutcome run_case(Simulation& s, RunOptions const& options, Listener& listener, std::atomic<int> const& stop) {
  if (!options.resume) check_results(options.folder, {s.spec.title, options.case_file, options.force});
  FolderLock const lock(options.folder);
  Journal journal(options.folder / "log.txt", listener);
  if (!options.resume) {
    clear_results(options.folder);
    journal.start(log_headline(s.spec.title));
  }
  if (!lock.held())
    journal.warn(fmt::format("{}: this file system knows no locks; nothing keeps another run from writing here",
                             options.folder.string()));
  for (std::string const& warning : s.warnings) journal.warn(warning);
  WallLimit wall(options.wall_time, options.started);
  Watch watch({options.folder, s.spec, s.particles, journal}, s.mass, listener, {options.checkpoint_request, &wall},
              options.also);
  auto const before = WallLimit::Clock::now();
  Moment moment = options.resume ? begin_again(s, options, journal, watch) : begin_new(s, options, journal, watch);
  if (wall.exists()) {
    wall.step_took(std::chrono::duration<double>(WallLimit::Clock::now() - before).count());
    wall.checkpoint_has(size_of_state(*s.formulation));
  }
  std::vector<Observer*> const observers = watch.all();
  March const end = march(*s.formulation, s.spec.run, moment, observers, {stop, wall}, &watch.relaxation);
  report_rest(s, watch.relaxation, end.ending, journal);
  for (Observer* observer : observers) observer->finish(*s.formulation, moment, end.ending);

  CaseOutcome outcome{.ending = end.ending,
                      .summary = summarise(s, moment, end.ending, watch.history.table(), journal),
                      .failure = {},
                      .out_of_time = end.out_of_time,
                      .last_picture = watch.pictures.last(),
                      .index = {}};
  outcome.summary.guards = watch.guards.report();
  if (end.failure) outcome.failure = failure_text(*end.failure, end.causes, moment, s.spec.run.cfl, options.folder);
  if (std::filesystem::exists(options.folder / "frames.hdf.series"))
    outcome.index = options.folder / "frames.hdf.series";
  if (watch.relaxation.active()) {
    Rest const& rest = watch.relaxation.rest();
    outcome.summary.relaxation = {rest.reached, rest.residual, rest.stops};
  }
  write_summary(options.folder / "summary.json", outcome.summary);
  journal.note(fmt::format("{} at step {}, t = {} s, {} of wall time", outcome.summary.status, moment.step, moment.time,
                           duration_text(moment.wall_seconds)));
  if (end.failure) journal.note(outcome.failure);
  if (end.out_of_time) journal.note("the wall time is used up");
  return outcome;
}

}  // namespace piola
