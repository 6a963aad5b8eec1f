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

/// Lets data out of a run. It sees the const state, so that a run with and without output is the same bit for bit.
class Observer {
 public:
  virtual ~Observer() = default;
  /// Called at the start of a new run and after each step.
  virtual void see(Formulation const& formulation, Moment const& moment) = 0;
  /// Called before a last step that has its length from the end of the run, so that a run with a later end would take
  /// another one; the moment is that of the step before.
  virtual void before_cut(Formulation const&, Moment const&) {}
  /// Called once, after the last step of this part of the run.
  virtual void finish(Formulation const&, Moment const&, Ending) {}
  /// Called before a checkpoint that counts on what was written: all of it is on the disk afterwards.
  virtual void sync() {}
  /// Set once the answer is not to be believed: the run then stops as failed.
  virtual std::optional<Objection> objection() const { return std::nullopt; }
  /// Files of the results folder that this run wrote, or found when it was resumed, and that must be there in the end.
  virtual std::vector<std::filesystem::path> files() const { return {}; }
  /// What a resumed run needs to continue; names are unique among observers.
  virtual void save(StateWriter&) const {}
  virtual void load(NamedState&, Moment const&) {}
};

/// What every observer needs to know. The references outlive the observers.
struct Results {
  std::filesystem::path folder;
  CaseSpec const& spec;
  ParticleSet const& particles;
  Journal& journal;
};

/// The columns of a history whose cells are left empty because they are not numbers.
class EmptyCells {
 public:
  /// columns: without a number in the row of `time` [s].
  void add(std::vector<std::string> const& columns, double time);
  /// Number of rows that had empty cells in columns that had none before.
  std::size_t rows() const { return rows_.size(); }
  /// One warning that lists the columns of these rows from number `first` on, each with the time of its first empty
  /// cell.
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
  /// Opens the file anew, or cut off after `resume_time` (after load). Called before the first step.
  void open(Formulation const& formulation, std::optional<double> resume_time);
  HistoryTable const& table() const { return file_->table(); }
  /// The numbers of the row of this step; null if it has none.
  Diagnostics const* row_of(std::int64_t step) const { return last_ && last_step_ == step ? &*last_ : nullptr; }

 private:
  void write_row(Formulation const& formulation, Moment const& moment);
  Results results_;
  Schedule schedule_;
  ProbeRow probes_;
  std::optional<HistoryFile> file_;
  HistoryMark mark_;  ///< of the checkpoint that the run was resumed from
  EmptyCells empty_cells_;
  std::optional<Diagnostics> last_;
  bool seen_at_start_ = false;  ///< last_ is of the state before the first step
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

/// Who asks for checkpoints besides the case, and who wants to know how long they take; nullptr: nobody.
struct CheckpointOrders {
  std::atomic<int>* request = nullptr;  ///< not 0: a checkpoint is wanted; put back to 0 when taken up
  WallLimit* wall = nullptr;
};

/// checkpoints/*.h5 at each due time, when asked for, at the end and when stopped. Keeps what the other observers need,
/// too. Before a last step that is cut to the end of the run there is one more: a run that is extended later continues
/// from there as if it had never had that end.
class CheckpointObserver : public Observer {
 public:
  CheckpointObserver(Results results, std::vector<Observer*> others, CheckpointOrders orders);
  void see(Formulation const& formulation, Moment const& moment) override;
  void before_cut(Formulation const& formulation, Moment const& moment) override;
  void finish(Formulation const& formulation, Moment const& moment, Ending ending) override;
  void load(NamedState& reader, Moment const& moment) override;
  std::vector<std::filesystem::path> files() const override { return {last_}; }

 private:
  /// All but the state of the formulation.
  Checkpoint take(Moment const& moment) const;
  void keep(Formulation const& formulation, Moment const& moment);
  Results results_;
  Schedule schedule_;
  std::vector<Observer*> others_;
  CheckpointOrders orders_;
  std::string particles_;       ///< record of them for checkpoints
  std::filesystem::path last_;  ///< the newest checkpoint of this run
};

/// Tells the listener how far the run is, a few times per second.
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
