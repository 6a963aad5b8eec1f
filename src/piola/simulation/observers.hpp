// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/output/checkpoint.hpp"
#include "piola/output/frames.hpp"
#include "piola/output/history.hpp"
#include "piola/simulation/journal.hpp"
#include "piola/simulation/moment.hpp"
#include "piola/simulation/objection.hpp"
#include "piola/simulation/probe_row.hpp"
#include "piola/simulation/schedule.hpp"
#include "piola/simulation/wall_limit.hpp"
#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace piola {

/// Extracts data from a run. Read access only, so that a run with and without output is bit-identical.
class Observer {
 public:
  virtual ~Observer() = default;
  /// Called at the start of a new run and after each step.
  virtual void see(Formulation const& formulation, Moment const& moment) = 0;
  /// Called before a last step that is shortened to the end of the run; the moment is that of the step before. A run
  /// with a later end would take another step.
  virtual void before_cut(Formulation const&, Moment const&) {}
  /// Called once, after the last step of this part of the run.
  virtual void finish(Formulation const&, Moment const&, Ending) {}
  /// Called before a checkpoint that refers to written data; afterwards these are on disk.
  virtual void sync() {}
  /// Set when the result is no longer reliable: the run then stops as failed.
  virtual std::optional<Objection> objection() const { return std::nullopt; }
  /// Files of the results folder that this run wrote, or found when resumed, and that must exist at the end.
  virtual std::vector<std::filesystem::path> files() const { return {}; }
  /// Saves the state that a resumed run needs; names are unique among observers.
  virtual void save(StateWriter&) const {}
  virtual void load(NamedState&, Moment const&) {}
};

/// Common data of all observers. The references outlive the observers.
struct Results {
  std::filesystem::path folder;
  CaseSpec const& spec;
  ParticleSet const& particles;
  Journal& journal;
};

/// Columns of a history with cells that are left empty because their values are not finite.
class EmptyCells {
 public:
  /// columns: without a finite value in the row of `time` [s].
  void add(std::vector<std::string> const& columns, double time);
  /// Number of rows with empty cells in columns that had none before.
  std::size_t rows() const { return rows_.size(); }
  /// One warning with the columns of these rows from number `first` on, each with the time of its first empty cell.
  std::string text(std::size_t first) const;

 private:
  std::vector<std::pair<double, std::vector<std::string>>> rows_;  ///< time [s] and columns
};

/// history.csv: one row at each due time and at the end.
class HistoryObserver : public Observer {
 public:
  explicit HistoryObserver(Results results);
  void see(Formulation const& formulation, Moment const& moment) override;
  void finish(Formulation const& formulation, Moment const& moment, Ending ending) override;
  void save(StateWriter& writer) const override;
  void load(NamedState& reader, Moment const& moment) override;
  void sync() override { file_->sync(); }
  std::vector<std::filesystem::path> files() const override { return {results_.folder / "history.csv"}; }
  /// Creates the file, or truncates it after `resume_time` (after load). Called before the first step.
  void open(Formulation const& formulation, std::optional<double> resume_time);
  HistoryTable const& table() const { return file_->table(); }
  /// The values of the row of this step; null if it has none.
  Diagnostics const* row_of(std::int64_t step) const { return last_ && last_step_ == step ? &*last_ : nullptr; }

 private:
  void write_row(Formulation const& formulation, Moment const& moment);
  Results results_;
  Schedule schedule_;
  ProbeRow probes_;
  std::optional<HistoryFile> file_;
  HistoryMark mark_;  ///< of the checkpoint from which the run was resumed
  EmptyCells empty_cells_;
  std::optional<Diagnostics> last_;
  bool seen_at_start_ = false;  ///< last_ is the state before the first step
  std::int64_t last_step_ = -1;
};

/// frames/*.hdf at each due time and at the end; the last state of a failed run always.
class FrameObserver : public Observer {
 public:
  explicit FrameObserver(Results results);
  void see(Formulation const& formulation, Moment const& moment) override;
  void finish(Formulation const& formulation, Moment const& moment, Ending ending) override;
  void save(StateWriter& writer) const override;
  void load(NamedState& reader, Moment const& moment) override;
  std::vector<std::filesystem::path> files() const override { return writer_.files(); }

 private:
  void write(Formulation const& formulation, double time);
  Results results_;
  Schedule schedule_;
  FrameWriter writer_;
};

/// External inputs of the checkpoint observer: a request flag and the wall-time limit, which receives the duration of
/// each checkpoint. Null: not used.
struct CheckpointOrders {
  std::atomic<int>* request = nullptr;  ///< nonzero: a checkpoint is requested; reset to 0 when accepted
  WallLimit* wall = nullptr;
};

/// Writes checkpoints/*.h5 at each due time, on request, at the end and when stopped, including the state of the other
/// observers. Writes one more before a last step that is shortened to the end of the run, from which a run with a later
/// end continues unaffected.
class CheckpointObserver : public Observer {
 public:
  CheckpointObserver(Results results, std::vector<Observer*> others, CheckpointOrders orders);
  void see(Formulation const& formulation, Moment const& moment) override;
  void before_cut(Formulation const& formulation, Moment const& moment) override;
  void finish(Formulation const& formulation, Moment const& moment, Ending ending) override;
  void load(NamedState& reader, Moment const& moment) override;
  std::vector<std::filesystem::path> files() const override { return {last_}; }

 private:
  /// Everything except the state of the formulation.
  Checkpoint take(Moment const& moment) const;
  void keep(Formulation const& formulation, Moment const& moment);
  Results results_;
  Schedule schedule_;
  std::vector<Observer*> others_;
  CheckpointOrders orders_;
  std::string particles_;       ///< description of the particles for checkpoints
  std::filesystem::path last_;  ///< the newest checkpoint of this run
};

/// Reports the progress to the listener, a few times per second.
class ProgressObserver : public Observer {
 public:
  ProgressObserver(Listener& listener, double end, std::int64_t particles, HistoryObserver const& history);
  void see(Formulation const& formulation, Moment const& moment) override;

 private:
  Listener& listener_;
  double end_;
  double particles_;
  HistoryObserver const& history_;
  std::chrono::steady_clock::time_point last_{};
  std::optional<Moment> first_;
};

}  // namespace piola
