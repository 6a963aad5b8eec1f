// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/observers/time_state.hpp"
#include "piola/simulation/dynamic_relaxation.hpp"
#include "piola/simulation/observers.hpp"
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

/// Conditions that end the time loop before the end time of the run.
struct StopConditions {
  std::atomic<int> const& asked;  ///< by a signal, if nonzero
  WallLimit& wall;
  Pause pause = {};
};

/// The time loop: from `moment` to the end time of `run`, or until `relaxation` converges, the physics fails, an
/// observer objects, or one of `stops` is reached. Observers have read access after each step; they never change the
/// step.
LoopResult march(Formulation& formulation, RunSpec const& run, TimeState& moment, std::span<Observer* const> observers,
                 StopConditions const& stops, Relaxation* relaxation = nullptr);

}  // namespace piola
