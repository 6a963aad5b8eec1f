// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/run_case.hpp"
#include "piola/base/problems.hpp"
#include "piola/base/text.hpp"
#include "piola/base/version.hpp"
#include "piola/exec/instruction_sets.hpp"
#include "piola/formulations/set_up_checks.hpp"
#include "piola/input/case_difference.hpp"
#include "piola/input/case_files.hpp"
#include "piola/output/files.hpp"
#include "piola/output/folder_lock.hpp"
#include "piola/setup/solid_bodies.hpp"
#include "piola/simulation/failure_text.hpp"
#include "piola/simulation/guard_observer.hpp"
#include "piola/simulation/observers.hpp"
#include "piola/simulation/picture_observer.hpp"
#include "piola/simulation/ranks.hpp"
#include "piola/simulation/relaxation.hpp"
#include "piola/simulation/results_folder.hpp"
#include "piola/simulation/run_summary.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola {

/// All observers of a run, in the order in which they look.
struct Watch {
  HistoryObserver history;
  GuardObserver guards;
  FrameObserver frames;
  PictureObserver pictures;
  Relaxation relaxation;
  CheckpointObserver checkpoints;
  ProgressObserver progress;

  std::vector<Observer*> also;
  bool written;  // to a folder

  Watch(Results const& results, double mass, Listener& listener, CheckpointOrders const& orders, Observer* last)
      : history(results),
        guards(results, mass, history),
        frames(results),
        pictures(results),
        relaxation(results.spec.run, results.particles, mass),
        checkpoints(results, {&history, &guards, &frames, &pictures, &relaxation}, orders),
        progress(listener, results.spec.run.end, results.particles.size(), history),
        written(!results.folder.empty()) {
    if (last != nullptr) also.push_back(last);
  }
  std::vector<Observer*> all() {
    std::vector<Observer*> list{&history, &guards};
    if (written) list.insert(list.end(), {&frames, &pictures});
    list.push_back(&relaxation);
    if (written) list.push_back(&checkpoints);
    list.push_back(&progress);
    list.insert(list.end(), also.begin(), also.end());
    return list;
  }
};

namespace {

std::string start_text(Simulation const& s) {
  return fmt::format("formulation {}, {} particles, {} thread(s), machine {}, end {}", s.formulation_name,
                     count_text(s.particles.size()), s.threads, s.spec.run.machine, quantity_text(s.spec.run.end, "s"));
}

void keep_file(CaseFile const& file, std::filesystem::path const& folder, Journal& journal) {
  constexpr std::uintmax_t most = 50'000'000;
  namespace fs = std::filesystem;
  fs::path const to = folder / kept_files / kept_name(file.given);
  std::error_code error;
  if (fs::equivalent(file.path, to, error)) return;
  if (fs::file_size(file.path, error) > most) {
    journal.warn(fmt::format("{} is larger than 50 MB and is not copied to the results: a resumed run reads it from {}",
                             file.given, file.path.string()));
    return;
  }
  fs::create_directories(folder / kept_files, error);
  if (!fs::copy_file(file.path, to, fs::copy_options::overwrite_existing, error))
    journal.warn(fmt::format("{} could not be copied to {}: {}", file.given, to.string(), error.message()));
}

/// Copies of the files that the case names, without which it could not be resumed elsewhere.
void keep_files(CaseSpec const& spec, std::filesystem::path const& folder, Journal& journal) {
  for (BodySpec const& body : spec.bodies) {
    if (body.shape.solid && body.shape.arrangement == ShapeSpec::Arrangement::packed) {
      make_folder(folder / kept_files);
      SolidParticles::of(body.shape).save(folder / kept_files);
    }
    for (CaseFile const& file : body.shape.files) keep_file(file, folder, journal);
  }
  for (RegionSpec const& region : spec.regions)
    for (CaseFile const& file : region.files) keep_file(file, folder, journal);
}

/// A new run: the folder is emptied of older results, the case is kept as run, the first state is looked at.
Moment begin_new(Simulation& s, RunOptions const& options, Journal& journal, Watch& watch) {
  journal.note(start_text(s));
  if (watch.written) {
    write_whole_file(options.folder / "case.toml", s.spec.source);
    keep_files(s.spec, options.folder, journal);
  }
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
    s.formulation->load(*c.in_file);
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
  StateSize size;
  formulation.save(size);
  return static_cast<std::int64_t>(size.numbers() * sizeof(double));
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

/// How good the set-up is.
void report_set_up(Formulation const& formulation, Journal& journal) {
  std::string numbers;
  for (SetUpCheck const& check : set_up_checks_of(formulation)) {
    if (!check.warning.empty()) journal.warn(check.warning);
    numbers += fmt::format("{}{} = {:.3g}", numbers.empty() ? "" : ", ", check.name, check.value);
  }
  if (!numbers.empty()) journal.note("set-up: " + numbers);
}

/// Says how a dynamic relaxation came to rest.
void report_rest(Relaxation const& relaxation, Journal& journal) {
  if (!relaxation.active()) return;
  if (relaxation.rest().reached)
    journal.note(fmt::format("at rest after {} stops: {}", relaxation.rest().stops, relaxation.text()));
  if (std::string const slow = relaxation.slow_text(); !slow.empty()) journal.warn(slow);
}

/// How often particles were shared out among ranks anew.
std::string recuts_text(Recuts const& recuts) {
  auto const percent = [](double share) { return fmt::format("{:.0f} %", 100 * share); };
  std::string text = fmt::format("particles were shared out among the ranks anew {} times", recuts.imbalance.size());
  for (std::size_t k = 0; k < recuts.imbalance.size() && k < 5; ++k)
    text += (k == 0 ? "; before, the busiest was above the mean by " : ", ") + percent(recuts.imbalance[k]);
  return text + "; at the end by " + percent(recuts.last);
}

/// Makes sure that the folder may be used, and keeps others out of it.
std::unique_ptr<FolderLock> take_folder(Simulation const& s, RunOptions const& options) {
  if (options.folder.empty()) return nullptr;
  if (!options.resume) check_results(options.folder, {s.spec.title, options.case_file, options.force});
  return std::make_unique<FolderLock>(options.folder);
}

}  // namespace

struct CaseRun::Parts {
  Simulation& simulation;
  RunOptions options;
  std::atomic<int> const& stop;
  std::unique_ptr<FolderLock> lock;  // null if nothing is written
  Journal journal;
  WallLimit wall;
  Watch watch;
  Moment moment;
  March last;  // how the last part ended

  Parts(Simulation& s, RunOptions const& given, Listener& listener, std::atomic<int> const& stop_request)
      : simulation(s),
        options(given),
        stop(stop_request),
        lock(take_folder(s, given)),
        journal(given.folder.empty() ? std::filesystem::path() : given.folder / "log.txt", listener),
        wall(given.wall_time, given.started),
        watch({given.folder, s.spec, s.particles, journal}, s.mass, listener, {given.checkpoint_request, &wall},
              given.also) {}
};

CaseRun::CaseRun(Simulation& s, RunOptions const& options, Listener& listener, std::atomic<int> const& stop)
    : parts_(std::make_unique<Parts>(s, options, listener, stop)) {
  Journal& journal = parts_->journal;
  if (!options.resume) {
    if (!options.folder.empty()) clear_results(options.folder);
    journal.start(log_headline(s.spec.title));
  }
  if (parts_->lock && !parts_->lock->held())
    journal.warn(fmt::format("{}: this file system knows no locks; nothing keeps another run from writing here",
                             options.folder.string()));
  for (std::string const& warning : s.warnings) journal.warn(warning);
  report_set_up(*s.formulation, journal);
  auto const before = WallLimit::Clock::now();
  parts_->moment =
      options.resume ? begin_again(s, options, journal, parts_->watch) : begin_new(s, options, journal, parts_->watch);
  if (!parts_->wall.exists()) return;
  parts_->wall.step_took(std::chrono::duration<double>(WallLimit::Clock::now() - before).count());
  parts_->wall.checkpoint_has(size_of_state(*s.formulation));
}

CaseRun::~CaseRun() = default;

Moment const& CaseRun::moment() const { return parts_->moment; }
void CaseRun::put_moment(Moment const& moment) { parts_->moment = moment; }
HistoryTable const& CaseRun::history() const { return parts_->watch.history.table(); }
void CaseRun::also(Observer& observer) { parts_->watch.also.push_back(&observer); }

March const& CaseRun::advance(Pause const& pause) {
  Parts& p = *parts_;
  RunSpec run = p.simulation.spec.run;
  if (pause.exactly) run.end = std::min(run.end, pause.time);
  p.last = march(*p.simulation.formulation, run, p.moment, p.watch.all(), {p.stop, p.wall, pause}, &p.watch.relaxation);
  p.last.paused = p.last.paused || (p.last.ending == Ending::completed && !p.moment.at_rest &&
                                    p.moment.time < p.simulation.spec.run.end);
  if (p.last.ending == Ending::completed && !p.last.paused && p.watch.relaxation.unfinished()) {
    Objection const not_at_rest = p.watch.relaxation.objection_at_end();
    p.last = {.ending = Ending::failed, .failure = not_at_rest.failure, .causes = not_at_rest.causes};
  }
  return p.last;
}

CaseOutcome CaseRun::finish() {
  Parts& p = *parts_;
  Simulation const& s = p.simulation;
  Ending const ending = p.last.paused ? Ending::stopped : p.last.ending;
  report_rest(p.watch.relaxation, p.journal);
  for (Observer* observer : p.watch.all()) observer->finish(*s.formulation, p.moment, ending);

  CaseOutcome outcome{.ending = ending,
                      .summary = summarise(s, p.moment, ending, history(), p.journal),
                      .failure = {},
                      .out_of_time = p.last.out_of_time,
                      .last_picture = p.watch.pictures.last(),
                      .index = {}};
  outcome.summary.guards = p.watch.guards.report();
  outcome.summary.ranks = traffic_on_ranks();
  if (!outcome.summary.ranks.empty()) outcome.summary.recuts = s.formulation->recuts();
  if (auto const& recuts = outcome.summary.recuts; recuts && !recuts->imbalance.empty())
    p.journal.note(recuts_text(*recuts));
  auto const& folder = p.options.folder;
  if (p.last.failure) outcome.failure = failure_text(*p.last.failure, p.last.causes, p.moment, s.spec.run.cfl, folder);
  if (p.watch.relaxation.active()) {
    Rest const& rest = p.watch.relaxation.rest();
    outcome.summary.relaxation = {rest.reached, rest.residual, rest.stops};
  }
  if (folder.empty()) return outcome;
  if (std::filesystem::exists(folder / "frames.hdf.series")) outcome.index = folder / "frames.hdf.series";
  write_summary(folder / "summary.json", outcome.summary);
  p.journal.note(fmt::format("{} at step {}, t = {} s, {} of wall time", outcome.summary.status, p.moment.step,
                             p.moment.time, duration_text(p.moment.wall_seconds)));
  if (p.last.failure) p.journal.note(outcome.failure);
  if (p.last.out_of_time) p.journal.note("the wall time is used up");
  p.lock.reset();
  return outcome;
}

CaseOutcome run_case(Simulation& simulation, RunOptions const& options, Listener& listener,
                     std::atomic<int> const& stop) {
  CaseRun run(simulation, options, listener, stop);
  run.advance();
  return run.finish();
}

}  // namespace piola
