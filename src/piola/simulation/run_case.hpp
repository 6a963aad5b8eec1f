// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/history.hpp"
#include "piola/output/summary.hpp"
#include "piola/simulation/build.hpp"
#include "piola/simulation/journal.hpp"
#include "piola/simulation/moment.hpp"
#include "piola/simulation/observers.hpp"
#include "piola/simulation/run.hpp"
#include "piola/simulation/wall_limit.hpp"
#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

namespace piola {

struct RunOptions {
  std::filesystem::path folder;          ///< of the results; empty: nothing is written
  bool resume = false;                   ///< continue from the newest checkpoint in `folder`
  bool force = false;                    ///< use a folder that holds other things
  std::filesystem::path case_file = {};  ///< that the case was read from: never replaced by results
  Observer* also = nullptr;              ///< looks on after all others; its state is in no checkpoint
  /// The run stops, with a checkpoint, before so much wall time [s] has gone since `started`.
  double wall_time = WallLimit::none;
  WallLimit::Clock::time_point started = WallLimit::Clock::now();
  /// Not 0: somebody asks for a checkpoint between two steps; put back to 0 when it is taken up. nullptr: nobody does.
  std::atomic<int>* checkpoint_request = nullptr;
};

struct CaseOutcome {
  Ending ending = Ending::completed;
  Summary summary;
  std::string failure;                        ///< the message for the user if ending is failed
  bool out_of_time = false;                   ///< stopped because the wall time is used up
  std::filesystem::path last_picture, index;  ///< empty if there is none
};

/// A case that runs with all its output, in parts; run_case does it in one.
class CaseRun {
 public:
  /// Begins at the start of the case or at its newest checkpoint. The references outlive the run. Throws InputError
  /// (the folder is refused, nothing to resume from, the case has changed) and FileError (output impossible).
  CaseRun(Simulation& simulation, RunOptions const& options, Listener& listener, std::atomic<int> const& stop);
  ~CaseRun();
  CaseRun(CaseRun const&) = delete;
  CaseRun& operator=(CaseRun const&) = delete;
  /// Runs on, to the pause or to the end. A run with pauses that are not exact is the same bit for bit as one without.
  /// Throws FileError.
  March const& advance(Pause const& pause = {});
  /// Ends the output: the last row and frame of a completed or failed run, a checkpoint of one that stands at a pause
  /// or was stopped. Called once. Throws FileError.
  CaseOutcome finish();
  /// One more that looks on, from the next step on; its state is in no checkpoint.
  void also(Observer& observer);
  Moment const& moment() const;
  /// For a state that was put into the formulation from outside, in a run that writes nothing.
  void put_moment(Moment const& moment);
  HistoryTable const& history() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Runs a case from its start (or its newest checkpoint) to its end with all its output. `stop` may be set by a signal
/// handler: the run then writes a checkpoint and returns with Ending::stopped, as it does in time before its wall time
/// is over. Throws InputError (the folder is refused, nothing to resume from, the case has changed) and FileError
/// (output impossible).
CaseOutcome run_case(Simulation& simulation, RunOptions const& options, Listener& listener,
                     std::atomic<int> const& stop);

}  // namespace piola
