// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/run_case.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/domain/error_agreement.hpp"
#include "piola/guards/failure_text.hpp"
#include "piola/guards/formula_failure.hpp"
#include "piola/input/case_files.hpp"
#include "piola/observers/results_folder.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/folder_lock.hpp"
#include "piola/setup/packed_bodies.hpp"
#include "piola/simulation/dynamic_relaxation.hpp"
#include "piola/simulation/guard_observer.hpp"
#include "piola/simulation/observers.hpp"
#include "piola/simulation/picture_observer.hpp"
#include "piola/simulation/restore.hpp"
#include "piola/simulation/run_summary.hpp"
#include "piola/simulation/state_hash.hpp"
#include "piola/simulation/step_observer.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola {

/// All observers of a run, in the order in which they look.
struct RunObservers {
  HistoryObserver history;
  GuardObserver guards;
  StepObserver steps;
  FrameObserver frames;
  PictureObserver pictures;
  Relaxation relaxation;
  CheckpointObserver checkpoints;
  ProgressObserver progress;

  std::vector<Observer*> also;
  bool written;  // to a folder

  RunObservers(Results const& results, double mass, Listener& listener, WallLimit& wall, Observer* last)
      : history(results),
        guards(results, mass, history),
        steps(results),
        frames(results),
        pictures(results, frames),
        relaxation(results.spec.run, results.particles, mass),
        checkpoints(results, {&history, &guards, &frames, &pictures, &relaxation}, wall),
        progress(listener, results.spec.run.end, results.particles.size(), history),
        written(!results.folder.empty()) {
    if (last != nullptr) also.push_back(last);
  }
  std::vector<Observer*> all() {
    std::vector<Observer*> list{&history, &guards};
    if (written) list.insert(list.end(), {&steps, &frames, &pictures});
    list.push_back(&relaxation);
    if (written) list.push_back(&checkpoints);
    list.push_back(&progress);
    list.insert(list.end(), also.begin(), also.end());
    return list;
  }
};

namespace {

std::string start_text(Simulation const& s) {
  return fmt::format("formulation {}, {} particles, {} thread(s), instruction set {}, end {}", s.formulation_name,
                     count_text(s.particles.size()), s.threads, s.spec.run.backend, quantity_text(s.spec.run.end, "s"));
}

/// Copies a file unless it is too large.
KeptFile keep_file(CaseFile const& file, std::size_t number, std::filesystem::path const& folder, RunLog& journal) {
  constexpr std::uint64_t most = 50'000'000;
  KeptFile kept{file.given, "", std::filesystem::absolute(file.path), FileToRead(file.path).size(),
                content_hash(file.path)};
  if (kept.bytes > most) {
    journal.warn(fmt::format("{} is larger than 50 MB and is not copied to the results: a resumed run reads it from {}",
                             file.given, kept.from.string()));
    return kept;
  }
  kept.kept = kept_name(number, file.given);
  write_whole_file(folder / kept.kept, read_text_file(file.path));
  return kept;
}

/// Copies of the files that the case names, without which it could not be resumed elsewhere, and the list of them.
void keep_files(CaseSpec const& spec, std::filesystem::path const& results, RunLog& journal) {
  auto const folder = results / kept_files;
  for (BodySpec const& body : spec.bodies)
    if (body.shape.solid && body.shape.arrangement == ShapeSpec::Arrangement::packed) {
      make_folder(folder);
      SolidParticles::of(body.shape).save(folder);
    }
  std::vector<KeptFile> list;
  for (CaseFile const& file : files_of(spec)) {
    make_folder(folder);
    list.push_back(keep_file(file, list.size() + 1, folder, journal));
  }
  if (!list.empty()) write_whole_file(folder / kept_list, text_of_list(list));
}

/// Starts a new run: removes older results from the folder, saves the case, and observes the first state.
TimeState begin_new(Simulation& s, RunOptions const& options, RunLog& journal, RunObservers& observers) {
  journal.note(start_text(s));
  for (std::string const& note : notes_of_tables(s.spec)) journal.note(note);
  if (observers.written)
    comm::on_root([&] {
      write_whole_file(options.folder / "case.toml", s.spec.source);
      keep_files(s.spec, options.folder, journal);
    });
  observers.history.open(*s.formulation, {});
  TimeState const moment;
  for (Observer* observer : observers.all()) observer->observe(*s.formulation, moment);
  return moment;
}

/// Bytes of the saved state of a formulation.
std::int64_t size_of_state(Formulation const& formulation) {
  StateSize size;
  formulation.save(size);
  return static_cast<std::int64_t>(size.numbers() * sizeof(double));
}

std::string hash_of_state(Formulation const& formulation) {
  StateHash hash;
  formulation.save(hash);
  hash.end_rows();
  return hash.text();
}

/// Resumes a run: restores the state of the newest valid checkpoint, with permitted changes of the case that do not
/// affect the state at a given time.
TimeState begin_again(Simulation& s, RunOptions const& options, RunLog& journal, RunObservers& observers) {
  comm::on_root([&] {
    Problems problems;
    compare_with_kept_list(s.spec, options.folder, problems);
    problems.raise_if_any();
  });
  auto moment = restore(s, options.folder, journal, observers.all(), false);
  if (!moment) {
    moment = restore(s, options.folder, journal, observers.all(), true);
    journal.warn(
        fmt::format("the step before t = {} s was cut to the end that the run had then, and no checkpoint from "
                    "before it is left; from there on the numbers differ in their last digits from those of a "
                    "run with the new end from the start",
                    moment->time));
  }
  comm::on_root([&] {
    auto const file = options.folder / "case.toml";
    if (read_text_file(file) != s.spec.source) write_whole_file(file, s.spec.source);
  });
  journal.note(fmt::format("resumed at step {}, t = {} s; {}", moment->step, moment->time, start_text(s)));
  observers.history.open(*s.formulation, moment->time);
  return *moment;
}

/// The numbers of the set-up.
void report_set_up(Formulation const& formulation, RunLog& journal) {
  std::string numbers;
  for (SetUpCheck const& check : formulation.statistics().set_up_checks)
    numbers += fmt::format("{}{} = {:.3g}", numbers.empty() ? "" : ", ", check.name, check.value);
  if (!numbers.empty()) journal.note("set-up: " + numbers);
}

/// Says how a dynamic relaxation came to rest.
void report_rest(Relaxation const& relaxation, RunLog& journal) {
  if (!relaxation.active()) return;
  if (relaxation.rest().reached)
    journal.note(fmt::format("at rest after {} {}: {}", relaxation.rest().stops,
                             relaxation.minimises() ? "iterations" : "stops", relaxation.text()));
  if (std::string const slow = relaxation.slow_text(); !slow.empty()) journal.warn(slow);
}

/// Missing files that the run wrote, in one sentence; empty if there are none.
std::string missing_results(RunOptions const& options, RunObservers& observers) {
  constexpr std::size_t few = 5;
  auto const& folder = options.folder;
  std::vector<std::filesystem::path> all{folder / "case.toml", folder / "log.txt"};
  // A run that is resumed may have lost copies before.
  for (KeptFile const& file : options.resume ? std::vector<KeptFile>() : read_kept_list(folder))
    if (!file.kept.empty()) all.push_back(folder / kept_files / file.kept);
  for (Observer* observer : observers.all()) {
    auto const files = observer->files();
    all.insert(all.end(), files.begin(), files.end());
  }
  std::vector<std::string> missing;
  for (auto const& file : all) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) missing.push_back(file.lexically_relative(folder).string());
  }
  if (missing.empty()) return "";
  std::string const more = missing.size() > few ? fmt::format(" and {} more", missing.size() - few) : "";
  return fmt::format(
      "{}: {}{} {} removed while the run went on (needed: all that it wrote) - run the case again, and "
      "leave its folder alone until it ends",
      folder.string(), joined(std::span(missing).first(std::min(few, missing.size()))), more,
      missing.size() == 1 ? "was" : "were");
}

/// Names a formula that was not finite as the cause of a failure.
void blame_formula(Simulation const& s, TimeState const& moment, LoopResult& last) {
  auto formula = failure_of_formula(s.spec, s.particles, moment);
  if (!formula) return;
  last.failure = std::move(*formula);
  last.causes =
      "a formula must be a finite number at all times up to run.end, or up to its until: look for divisions by zero, "
      "roots of negative numbers and exp of large ones";
}

/// Number of repartitions, as text.
std::string repartition_text(RepartitionStatistics const& repartition_statistics) {
  auto const percent = [](double share) { return fmt::format("{:.0f} %", 100 * share); };
  std::string text = fmt::format("particles were repartitioned {} times", repartition_statistics.imbalance.size());
  for (std::size_t k = 0; k < repartition_statistics.imbalance.size() && k < 5; ++k)
    text +=
        (k == 0 ? "; before, the busiest was above the mean by " : ", ") + percent(repartition_statistics.imbalance[k]);
  return text + "; at the end by " + percent(repartition_statistics.last);
}

/// Adds the results of observers and ranks over the whole run. Collective.
void add_observed(Summary& summary, Simulation const& s, RunObservers const& observers, StepTraffic const& traffic,
                  RunLog& journal) {
  summary.guards = observers.guards.report();
  summary.bits = hash_of_state(*s.formulation);
  summary.ranks = traffic.of_ranks();
  if (!summary.ranks.empty()) summary.repartition_statistics = s.formulation->statistics().repartition;
  if (auto const& repartition_statistics = summary.repartition_statistics;
      repartition_statistics && !repartition_statistics->imbalance.empty())
    journal.note(repartition_text(*repartition_statistics));
  if (!observers.relaxation.active()) return;
  RelaxationStatus const& rest = observers.relaxation.rest();
  summary.relaxation = {rest.reached, rest.residual, rest.stops, rest.left};
}

/// Checks that the folder may be used, and locks it against other processes. Collective; null on other ranks than 0.
std::unique_ptr<FolderLock> take_folder(Simulation const& s, RunOptions const& options) {
  std::unique_ptr<FolderLock> lock;
  if (options.folder.empty()) return lock;
  comm::on_root([&] {
    if (!options.resume) check_results(options.folder, {s.spec.title, options.case_file, options.force});
    lock = std::make_unique<FolderLock>(options.folder);
  });
  return lock;
}

/// log.txt, which only rank 0 writes; empty if nothing is written.
std::filesystem::path log_file(RunOptions const& options) {
  return options.folder.empty() || comm::rank() != 0 ? std::filesystem::path() : options.folder / "log.txt";
}

}  // namespace

struct CaseRun::Parts {
  Simulation& simulation;
  RunOptions options;
  std::atomic<int> const& stop;
  std::unique_ptr<FolderLock> lock;  // null if nothing is written, or by other ranks
  RunLog journal;
  WallLimit wall;
  RunObservers observers;
  TimeState moment;
  StepTraffic traffic;
  LoopResult last;  // how the last part ended

  void write_outcome(CaseOutcome& outcome);
  Parts(Simulation& s, RunOptions const& given, Listener& listener, std::atomic<int> const& stop_request)
      : simulation(s),
        options(given),
        stop(stop_request),
        lock(take_folder(s, given)),
        journal(log_file(given), listener),
        wall(given.wall_time, given.started),
        observers({given.folder, s.spec, s.particles, journal}, s.mass, listener, wall, given.also) {}
};

/// Writes summary.json and the end of the log. Throws FileError if results are missing.
void CaseRun::Parts::write_outcome(CaseOutcome& outcome) {
  auto const& folder = options.folder;
  std::string const missing = missing_results(options, observers);
  if (!missing.empty()) outcome.summary.warnings.push_back(missing);
  if (!missing.empty() && !last.failure) outcome.summary.status = "incomplete";
  if (std::filesystem::exists(folder / "frames.hdf.series")) outcome.index = folder / "frames.hdf.series";
  write_summary(folder / "summary.json", outcome.summary);
  if (!missing.empty() && !last.failure) throw FileError(missing);
  journal.note(fmt::format("{} at step {}, t = {} s, {} of wall time", outcome.summary.status, moment.step, moment.time,
                           duration_text(moment.wall_seconds)));
  if (last.failure) journal.note(outcome.failure);
  if (last.out_of_time) journal.note("the wall time is used up");
}

CaseRun::CaseRun(Simulation& s, RunOptions const& options, Listener& listener, std::atomic<int> const& stop)
    : parts_(std::make_unique<Parts>(s, options, listener, stop)) {
  PIOLA_EXPECTS(s.formulation != nullptr);
  RunLog& journal = parts_->journal;
  if (!options.resume)
    comm::on_root([&] {
      if (!options.folder.empty()) clear_results(options.folder);
      journal.start(log_headline(s.spec.title));
    });
  if (parts_->lock && !parts_->lock->held())
    journal.warn(fmt::format("{}: this file system knows no locks; nothing keeps another run from writing here",
                             options.folder.string()));
  for (std::string const& warning : s.warnings) journal.warn(warning);
  report_set_up(*s.formulation, journal);
  auto const before = WallLimit::Clock::now();
  parts_->moment = options.resume ? begin_again(s, options, journal, parts_->observers)
                                  : begin_new(s, options, journal, parts_->observers);
  if (!parts_->wall.exists()) return;
  parts_->wall.step_took(std::chrono::duration<double>(WallLimit::Clock::now() - before).count());
  parts_->wall.checkpoint_has(size_of_state(*s.formulation));
}

CaseRun::~CaseRun() = default;

TimeState const& CaseRun::moment() const { return parts_->moment; }
void CaseRun::put_moment(TimeState const& moment) {
  PIOLA_EXPECTS(moment.step >= 0 && std::isfinite(moment.time));
  parts_->moment = moment;
}
HistoryTable const& CaseRun::history() const { return parts_->observers.history.table(); }
void CaseRun::also(Observer& observer) { parts_->observers.also.push_back(&observer); }

LoopResult const& CaseRun::advance(Pause const& pause) {
  Parts& p = *parts_;
  RunSpec run = p.simulation.spec.run;
  // A cut step changes the steps after it: the case alone no longer determines the results.
  if (pause.exactly && pause.time < run.end) p.simulation.spec.identity.run.clear();
  if (pause.exactly) run.end = std::min(run.end, pause.time);
  p.last = march(*p.simulation.formulation, run, p.moment, p.observers.all(),
                 {p.stop, p.wall, pause, p.options.checkpoint_request}, &p.observers.relaxation, &p.traffic);
  p.last.paused = p.last.paused || (p.last.ending == RunStatus::completed && !p.moment.at_rest &&
                                    p.moment.time < p.simulation.spec.run.end);
  if (p.last.ending == RunStatus::completed && !p.last.paused && p.observers.relaxation.unfinished()) {
    StopRequest const not_at_rest = p.observers.relaxation.objection_at_end();
    p.last = {.ending = RunStatus::failed, .failure = not_at_rest.failure, .causes = not_at_rest.causes};
  }
  return p.last;
}

CaseOutcome CaseRun::finish() {
  Parts& p = *parts_;
  Simulation const& s = p.simulation;
  RunStatus const ending = p.last.paused ? RunStatus::stopped : p.last.ending;
  report_rest(p.observers.relaxation, p.journal);
  for (Observer* observer : p.observers.all()) observer->finish(*s.formulation, p.moment, ending);

  CaseOutcome outcome{.ending = ending,
                      .summary = summarise(s, p.moment, ending, history(), p.journal),
                      .failure = {},
                      .out_of_time = p.last.out_of_time,
                      .last_picture = p.observers.pictures.last(),
                      .index = {}};
  add_observed(outcome.summary, s, p.observers, p.traffic, p.journal);
  auto const& folder = p.options.folder;
  if (p.last.failure) {
    add_energies(*p.last.failure, history());
    blame_formula(s, p.moment, p.last);
  }
  if (p.last.failure)
    outcome.failure =
        failure_text(*p.last.failure, p.last.causes, p.moment, s.formulation->step_estimate().limit, folder);
  comm::on_root([&] {
    if (!folder.empty()) p.write_outcome(outcome);
  });
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
