// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/contracts.hpp"
#include "piola/measures/probe_set.hpp"
#include "piola/observers/observer.hpp"
#include "piola/observers/output_schedule.hpp"
#include "piola/output/checkpoint.hpp"
#include "piola/output/frames.hpp"
#include "piola/output/history.hpp"
#include "piola/simulation/wall_time_limit.hpp"
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace piola {

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
  void observe(Formulation const& formulation, TimeState const& moment) override;
  void finish(Formulation const& formulation, TimeState const& moment, RunStatus ending) override;
  void save(StateWriter& writer) const override;
  void load(NamedState& reader, TimeState const& moment) override;
  void sync() override {
    PIOLA_EXPECTS(file_.has_value());
    file_->sync();
  }
  std::vector<std::filesystem::path> files() const override { return {results_.folder / "history.csv"}; }
  /// Creates the file, or truncates it after `resume_time` (after load). Called before the first step.
  void open(Formulation const& formulation, std::optional<double> resume_time);
  HistoryTable const& table() const {
    PIOLA_EXPECTS(file_.has_value());
    return file_->table();
  }
  /// The values of the row of this step; null if it has none.
  Diagnostics const* row_of(std::int64_t step) const { return last_ && last_step_ == step ? &*last_ : nullptr; }

 private:
  void write_row(Formulation const& formulation, TimeState const& moment);
  Results results_;
  Schedule schedule_;
  ProbeSet probes_;
  std::optional<HistoryFile> file_;
  HistoryMark mark_;  ///< of the checkpoint from which the run was resumed
  EmptyCells empty_cells_;
  std::optional<Diagnostics> last_;
  bool seen_at_start_ = false;   ///< last_ is the state before the first step
  std::int64_t last_step_ = -1;  ///< of the last row, which may be from before a run was resumed; -1: no row
};

/// frames/*.hdf at each due time and at the end; the last state of a failed run always. Those of pictures are written
/// by PictureObserver through write().
class FrameObserver : public Observer {
 public:
  explicit FrameObserver(Results results);
  void observe(Formulation const& formulation, TimeState const& moment) override;
  void finish(Formulation const& formulation, TimeState const& moment, RunStatus ending) override;
  void save(StateWriter& writer) const override;
  void load(NamedState& reader, TimeState const& moment) override;
  std::vector<std::filesystem::path> files() const override { return writer_.files(); }
  /// Writes a frame unless the last one is of this time [s].
  void write(Formulation const& formulation, double time, bool failed = false);
  /// Times of the frames written so far [s].
  std::vector<double> const& times() const { return writer_.times(); }

 private:
  Results results_;
  Schedule schedule_;
  FrameWriter writer_;
};

/// Writes checkpoints/*.h5 at each due time, on request, at the end and when stopped, including the state of the other
/// observers. Writes one more before a last step that is shortened to the end of the run, from which a run with a later
/// end continues unaffected.
class CheckpointObserver : public Observer {
 public:
  /// wall: receives the duration of each checkpoint.
  CheckpointObserver(Results results, std::vector<Observer*> others, WallLimit& wall);
  void observe(Formulation const& formulation, TimeState const& moment) override;
  void before_shortened_step(Formulation const& formulation, TimeState const& moment) override;
  void finish(Formulation const& formulation, TimeState const& moment, RunStatus ending) override;
  void load(NamedState& reader, TimeState const& moment) override;
  std::vector<std::filesystem::path> files() const override { return {last_}; }

 private:
  /// Everything except the state of the formulation.
  Checkpoint take(TimeState const& moment) const;
  void keep(Formulation const& formulation, TimeState const& moment);
  Results results_;
  Schedule schedule_;
  std::vector<Observer*> others_;
  WallLimit& wall_;
  std::string particles_;       ///< description of the particles for checkpoints
  std::filesystem::path last_;  ///< the newest checkpoint of this run
};

/// Reports the progress to the listener, a few times per second.
class ProgressObserver : public Observer {
 public:
  ProgressObserver(Listener& listener, double end, std::int64_t particles, HistoryObserver const& history);
  void observe(Formulation const& formulation, TimeState const& moment) override;

 private:
  Listener& listener_;
  double end_;
  double particles_;
  HistoryObserver const& history_;
  std::chrono::steady_clock::time_point last_{};
  std::optional<TimeState> first_;
  int stages_per_step_ = 1;  ///< read at the first observation, because statistics() is expensive
};

}  // namespace piola
