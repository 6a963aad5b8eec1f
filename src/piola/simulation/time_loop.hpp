// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/observers/time_state.hpp"
#include "piola/simulation/dynamic_relaxation.hpp"
#include "piola/simulation/observers.hpp"
#include "piola/simulation/step_traffic.hpp"
#include "piola/simulation/wall_time_limit.hpp"
#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>

namespace piola {

/// Stop of the time loop before the end of the run.
struct Pause {
  double time = std::numeric_limits<double>::infinity();         ///< s, at the first step that reaches it
  std::int64_t step = std::numeric_limits<std::int64_t>::max();  ///< after this step
  bool exactly = false;  ///< the last step is shortened to `time`, as at the end of a run (CaseRun::advance)
};

/// Result of the time loop.
struct LoopResult {
  RunStatus ending = RunStatus::completed;
  std::optional<Failure> failure = {};  ///< set if ending is failed
  std::string causes = {};              ///< likely causes, if more specific than those of the failure
  bool out_of_time = false;             ///< stopped by the wall-time limit
  bool paused = false;                  ///< the run can continue from here; ending is stopped
};

/// Requests from outside the time loop: signals, wall time, a pause. On several ranks those of rank 0 count.
struct LoopControl {
  std::atomic<int> const& stop;  ///< nonzero: a signal ends the run
  WallLimit& wall;
  Pause pause = {};
  std::atomic<int>* checkpoint_request = nullptr;  ///< nonzero: a checkpoint is requested; reset to 0 when accepted
};

/// The time loop: from `moment` to the end time of `run`, or until `relaxation` converges, the physics fails, an
/// observer objects, or `control` ends it. Observers have read access after each step; they never change the step.
/// traffic: of the steps; nullptr: not counted. On several ranks all ranks run the loop alike: everything that decides
/// is equal on all, and signals and wall time of rank 0 travel with the sums of a step, so that they count from the
/// step after them on.
LoopResult march(Formulation& formulation, RunSpec const& run, TimeState& moment, std::span<Observer* const> observers,
                 LoopControl const& control, Relaxation* relaxation = nullptr, StepTraffic* traffic = nullptr);

}  // namespace piola
