// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/history.hpp"
#include "piola/output/summary.hpp"
#include "piola/simulation/build.hpp"
#include "piola/simulation/journal.hpp"
#include "piola/simulation/moment.hpp"
#include "piola/simulation/observers.hpp"
#include "piola/simulation/wall_limit.hpp"
#include <atomic>
#include <filesystem>
#include <string>

namespace piola {

struct RunOptions {
  std::filesystem::path folder;          ///< of the results
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

/// Runs a case from its start (or its newest checkpoint) to its end with all its output. `stop` may be set by a signal
/// handler: the run then writes a checkpoint and returns with Ending::stopped, as it does in time before its wall time
/// is over. Throws InputError (the folder is refused, nothing to resume from, the case has changed) and FileError
/// (output impossible).
CaseOutcome run_case(Simulation& simulation, RunOptions const& options, Listener& listener,
                     std::atomic<int> const& stop);

/// Largest rise of (total energy - external work) above any earlier row, by the largest total energy of the history.
double energy_increase(HistoryTable const& history);
/// Its largest fall below any earlier row, likewise: what stabilisation, viscosity and friction took.
double energy_decrease(HistoryTable const& history);

}  // namespace piola
