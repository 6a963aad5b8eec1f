// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/observers.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/base/version.hpp"
#include "piola/domain/error_agreement.hpp"
#include "piola/exec/backend_registry.hpp"
#include "piola/exec/heap_tuning.hpp"
#include "piola/input/contact_capabilities.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/particles/particle_record.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola {
namespace {

constexpr int history_rows = 500;  // default number of rows of the history

double history_interval(CaseSpec const& spec) {
  return spec.output.history_every > 0 ? spec.output.history_every : spec.run.end / history_rows;
}

/// The units that formulations announce for the columns that they add.
void take_units(CaseSpec const& spec, std::vector<HistoryColumn>& columns) {
  for (FormulationInfo const& info : formulations_of(spec))
    for (DiagnosticInfo const& announced : info.diagnostics)
      for (HistoryColumn& column : columns)
        if (column.name == announced.name) column.unit = announced.unit;
}

}  // namespace

void EmptyCells::add(std::vector<std::string> const& columns, double time) {
  std::vector<std::string> fresh;
  for (std::string const& column : columns) {
    bool const known = std::any_of(rows_.begin(), rows_.end(), [&](auto const& at) {
      return std::find(at.second.begin(), at.second.end(), column) != at.second.end();
    });
    if (!known) fresh.push_back(column);
  }
  if (!fresh.empty()) rows_.emplace_back(time, std::move(fresh));
}

std::string EmptyCells::text(std::size_t first) const {
  PIOLA_EXPECTS(first < rows_.size());
  std::string text;
  for (std::size_t k = first; k < rows_.size(); ++k)
    text += fmt::format("{}{} at t = {} s", text.empty() ? "" : ", then ", joined(rows_[k].second), rows_[k].first);
  return fmt::format("history.csv: not a number in {}; such cells are left empty", text);
}

HistoryObserver::HistoryObserver(Results results)
    : results_(std::move(results)),
      schedule_(history_interval(results_.spec)),
      probes_(results_.spec, results_.particles) {}

void HistoryObserver::open(Formulation const& formulation, std::optional<double> resume_time) {
  last_ = formulation.diagnose();
  // A new run has its first row from the same state.
  seen_at_start_ = !resume_time;
  auto columns = diagnostic_columns(*last_);
  take_units(results_.spec, columns);
  for (Probe const& probe : probes_.probes()) {
    auto const more = probe.columns();
    columns.insert(columns.end(), more.begin(), more.end());
  }
  // The file is that of rank 0; other ranks keep the rows of this part of the run.
  bool const is_written = !results_.folder.empty() && comm::rank() == 0;
  auto const path = is_written ? results_.folder / "history.csv" : std::filesystem::path();
  comm::agree_after([&] {
    if (resume_time && !path.empty())
      file_.emplace(path, std::move(columns), *resume_time, mark_);
    else
      file_.emplace(path, std::move(columns));
  });
  if (!file_->repair_note().empty()) results_.journal.warn(file_->repair_note());
  auto const& rows = table().rows;
  last_step_ = comm::of_root(rows.empty() ? std::int64_t{-1} : std::lround(rows.back()[1]));
}

void HistoryObserver::write_row(Formulation const& formulation, TimeState const& moment) {
  if (!seen_at_start_ || moment.step > 0) last_ = formulation.diagnose();
  last_step_ = moment.step;
  auto row = diagnostic_values(moment.time, moment.step, moment.dt, *last_);
  for (auto const& more : probes_.evaluate(formulation, moment.time)) row.insert(row.end(), more.begin(), more.end());
  std::size_t const rows_before = empty_cells_.rows();
  comm::agree_after([&] { empty_cells_.add(file_->append(row), moment.time); });
  // The first such row is reported at once, columns that follow it in one warning at the end of the run.
  if (rows_before == 0 && empty_cells_.rows() > 0) results_.journal.warn(empty_cells_.text(0));
}

void HistoryObserver::observe(Formulation const& formulation, TimeState const& moment) {
  if (schedule_.due(moment.time)) write_row(formulation, moment);
}

void HistoryObserver::finish(Formulation const& formulation, TimeState const& moment, RunStatus ending) {
  PIOLA_EXPECTS(file_.has_value());
  bool const written = last_step_ == moment.step;
  // A stopped run gets no extra row, so that the history of a resumed run equals that of an uninterrupted one.
  if (!written && ending != RunStatus::stopped) write_row(formulation, moment);
  if (empty_cells_.rows() > 1) results_.journal.warn(empty_cells_.text(1));
}

void HistoryObserver::save(StateWriter& writer) const {
  PIOLA_EXPECTS(file_.has_value());
  std::vector<double> angles;
  for (Probe const& probe : probes_.probes()) angles.push_back(probe.state());
  writer.put("probe_angles", angles);
  HistoryMark const mark = file_->mark();
  writer.put("history_file", std::array{static_cast<double>(mark.rows), static_cast<double>(mark.bytes),
                                        static_cast<double>(mark.check_sum)});
}

void HistoryObserver::load(NamedState& reader, TimeState const& moment) {
  schedule_.start_after(moment.time);
  std::vector<Probe>& probes = probes_.probes();
  std::vector<double> angles(probes.size());
  reader.get("probe_angles", angles);
  for (std::size_t k = 0; k < probes.size(); ++k) probes[k].restore(angles[k]);
  std::array<double, 3> mark{};
  reader.get("history_file", mark);
  mark_ = {static_cast<std::uint64_t>(mark[0]), static_cast<std::uint64_t>(mark[1]),
           static_cast<std::uint32_t>(mark[2])};
}

FrameObserver::FrameObserver(Results results)
    : results_(std::move(results)),
      schedule_(results_.spec.output.frames_every),
      writer_(results_.folder, {}, results_.spec.output.compress) {}

void FrameObserver::write(Formulation const& formulation, double time, bool failed) {
  PIOLA_EXPECTS(std::isfinite(time));
  if (!times().empty() && times().back() == time) return;
  writer_.set_fields(fields_of_frames(results_.spec.output, failed));
  FieldCache cache(formulation, results_.particles, FieldCache::Of::local);
  writer_.write(time, cache);
}

void FrameObserver::observe(Formulation const& formulation, TimeState const& moment) {
  if (schedule_.due(moment.time)) write(formulation, moment.time);
}

void FrameObserver::finish(Formulation const& formulation, TimeState const& moment, RunStatus ending) {
  bool const failed = ending == RunStatus::failed;
  // A frame of pictures alone has not all fields.
  if (failed && !schedule_.ever() && !times().empty() && times().back() == moment.time)
    writer_.continue_after({times().begin(), times().end() - 1});
  if (failed || (ending == RunStatus::completed && schedule_.ever())) write(formulation, moment.time, failed);
}

void FrameObserver::save(StateWriter& writer) const { writer.put("frame_times", writer_.times()); }

void FrameObserver::load(NamedState& reader, TimeState const& moment) {
  schedule_.start_after(moment.time);
  auto const missing = writer_.continue_after(reader.all("frame_times"));
  if (missing.empty()) return;
  results_.journal.warn(fmt::format("{}: {} of {} frames up to the checkpoint {} missing", missing.front(),
                                    missing.size(), writer_.times().size(), missing.size() == 1 ? "is" : "are"));
}

CheckpointObserver::CheckpointObserver(Results results, std::vector<Observer*> others, WallLimit& wall)
    : results_(std::move(results)),
      schedule_(results_.spec.output.checkpoints_every),
      others_(std::move(others)),
      wall_(wall),
      particles_(results_.folder.empty() || comm::rank() != 0 ? "" : particle_record(results_.particles)) {
  PIOLA_EXPECTS(std::find(others_.begin(), others_.end(), nullptr) == others_.end());
  schedule_.due(0);  // the state at the start is the case itself
}

Checkpoint CheckpointObserver::take(TimeState const& moment) const {
  // Without the build where the run has no identity: it stays so when the run is resumed.
  Identity const& identity = results_.spec.identity;
  Checkpoint c{moment.time,
               moment.step,
               moment.dt,
               moment.first_dt,
               moment.wall_seconds,
               moment.stepping_seconds,
               moment.cut_to_end,
               identity.run.empty() ? std::string(version()) : identity.program,
               exec_host::backend_text(results_.spec.run.backend),
               results_.spec.source,
               particles_,
               {},
               {},
               {}};
  for (Observer const* other : others_) other->save(c.observers);
  return c;
}

void CheckpointObserver::keep(Formulation const& formulation, TimeState const& moment) {
  auto const start = WallLimit::Clock::now();
  comm::on_root([&] {
    for (Observer* other : others_) other->sync();
  });
  last_ = checkpoint_path(results_.folder, moment.step);
  keep_checkpoint(results_.folder, take(moment), [&](StateWriter& writer) { formulation.save(writer); });
  exec_host::trim_heap();
  wall_.checkpoint_took(std::chrono::duration<double>(WallLimit::Clock::now() - start).count());
}

void CheckpointObserver::observe(Formulation const& formulation, TimeState const& moment) {
  bool const due = schedule_.due(moment.time);
  if (due || moment.checkpoint_requested) keep(formulation, moment);
  if (moment.checkpoint_requested)
    results_.journal.note(fmt::format("checkpoint at step {}, t = {} s, as asked", moment.step, moment.time));
}

void CheckpointObserver::before_shortened_step(Formulation const& formulation, TimeState const& moment) {
  keep(formulation, moment);
}

void CheckpointObserver::finish(Formulation const& formulation, TimeState const& moment, RunStatus ending) {
  if (ending == RunStatus::failed) {
    last_ = results_.folder / failed_checkpoint;
    write_checkpoint(last_, take(moment), [&](StateWriter& writer) { formulation.save(writer); });
  } else {
    keep(formulation, moment);
  }
}

void CheckpointObserver::load(NamedState&, TimeState const& moment) { schedule_.start_after(moment.time); }

ProgressObserver::ProgressObserver(Listener& listener, double end, std::int64_t particles,
                                   HistoryObserver const& history)
    : listener_(listener), end_(end), particles_(static_cast<double>(particles)), history_(history) {
  PIOLA_EXPECTS(particles >= 0);
}

void ProgressObserver::observe(Formulation const& formulation, TimeState const& moment) {
  constexpr std::chrono::milliseconds pause(200);
  auto const now = std::chrono::steady_clock::now();
  if (!first_) {
    first_ = moment;
    stages_per_step_ = formulation.statistics().stages_per_step;
  }
  if (now - last_ < pause && moment.time < end_) return;
  last_ = now;
  Progress p{.moment = moment, .end = end_};
  auto const& table = history_.table();
  if (auto const column = table.find("total_energy"); column && !table.rows.empty())
    p.total_energy = table.rows.back()[*column];
  double const stages = static_cast<double>(moment.step) * stages_per_step_ * particles_;
  if (moment.stepping_seconds > 0) p.stages_per_second = stages / moment.stepping_seconds;
  double const advanced = moment.time - first_->time;
  if (advanced > 0) p.seconds_left = (end_ - moment.time) * (moment.wall_seconds - first_->wall_seconds) / advanced;
  listener_.progress(p);
}

}  // namespace piola
