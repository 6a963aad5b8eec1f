// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/observers/run_log.hpp"
#include "piola/observers/time_state.hpp"
#include "piola/output/history.hpp"
#include "piola/output/summary.hpp"
#include "piola/simulation/build.hpp"
#include "piola/simulation/observers.hpp"
#include "piola/simulation/time_loop.hpp"
#include "piola/simulation/wall_time_limit.hpp"
#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

namespace piola {

struct RunOptions {
  std::filesystem::path folder;          ///< of the results; empty: nothing is written
  bool resume = false;                   ///< continue from the newest checkpoint in `folder`
  bool force = false;                    ///< allow a folder with other content
  std::filesystem::path case_file = {};  ///< source of the case: never replaced by results
  Observer* also = nullptr;              ///< additional observer, called last; not saved in checkpoints
  /// Wall-time limit [s] since `started`: the run stops before it, with a checkpoint.
  double wall_time = WallLimit::none;
  WallLimit::Clock::time_point started = WallLimit::Clock::now();
  /// Nonzero: a checkpoint is requested between two steps; reset to 0 when accepted. nullptr: not used.
  std::atomic<int>* checkpoint_request = nullptr;
};

struct CaseOutcome {
  RunStatus ending = RunStatus::completed;
  Summary summary;
  std::string failure;                        ///< the message for the user if ending is failed
  bool out_of_time = false;                   ///< stopped by the wall-time limit
  std::filesystem::path last_picture, index;  ///< empty if there is none
};

/// A case with all its output, run in parts; run_case runs it at once.
class CaseRun {
 public:
  /// Starts at the beginning of the case or at its newest checkpoint. The references must outlive the run. Throws
  /// InputError (the folder is refused, nothing to resume from, the case has changed) and FileError (output
  /// impossible).
  CaseRun(Simulation& simulation, RunOptions const& options, Listener& listener, std::atomic<int> const& stop);
  ~CaseRun();
  CaseRun(CaseRun const&) = delete;
  CaseRun& operator=(CaseRun const&) = delete;
  /// Continues to the pause or to the end. A run with inexact pauses is bit-identical to one without. Throws FileError.
  LoopResult const& advance(Pause const& pause = {});
  /// Ends the output: the last row and frame of a completed or failed run, a checkpoint of a paused or stopped one.
  /// Call once. Throws FileError.
  CaseOutcome finish();
  /// Adds an observer from the next step on; it is not saved in checkpoints.
  void also(Observer& observer);
  TimeState const& moment() const;
  /// Sets the moment of a state that was set in the formulation externally, in a run without output.
  void put_moment(TimeState const& moment);
  HistoryTable const& history() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Runs a case from its start (or its newest checkpoint) to its end with all its output. `stop` may be set by a signal
/// handler: the run then writes a checkpoint and returns with RunStatus::stopped, as it does before the wall-time
/// limit. Throws InputError (the folder is refused, nothing to resume from, the case has changed) and FileError (output
/// impossible).
CaseOutcome run_case(Simulation& simulation, RunOptions const& options, Listener& listener,
                     std::atomic<int> const& stop);

}  // namespace piola
