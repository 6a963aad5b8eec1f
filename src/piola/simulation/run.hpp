// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/simulation/moment.hpp"
#include "piola/simulation/observers.hpp"
#include "piola/simulation/relaxation.hpp"
#include "piola/simulation/wall_limit.hpp"
#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>

namespace piola {

/// Where the main loop is to hold before the end of the run.
struct Pause {
  double time = std::numeric_limits<double>::infinity();         ///< s, at the first step that reaches it
  std::int64_t step = std::numeric_limits<std::int64_t>::max();  ///< after this one
  bool exactly = false;  ///< a last step is cut to `time`, as at the end of a run (CaseRun::advance)
};

/// How the main loop ended.
struct March {
  Ending ending = Ending::completed;
  std::optional<Failure> failure = {};  ///< set if ending is failed
  std::string causes = {};              ///< likely ones, where more is known than the failure says
  bool out_of_time = false;             ///< stopped because the wall time is used up
  bool paused = false;                  ///< the run can go on from here; ending is stopped
};

/// What ends the main loop before the end time of the run.
struct Stops {
  std::atomic<int> const& asked;  ///< by a signal, when it is not zero
  WallLimit& wall;
  Pause pause = {};
};

/// The main loop: from `moment` to the end time of `run`, or until the bodies are at rest if `relaxation` looks for
/// that, or until the physics fails or an observer objects, or until one of `stops` says so. Observers see the const
/// state after each step; they never change the step.
March march(Formulation& formulation, RunSpec const& run, Moment& moment, std::span<Observer* const> observers,
            Stops const& stops, Relaxation* relaxation = nullptr);

}  // namespace piola
