// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include <cstdint>
#include <optional>

namespace piola {

/// Result of trial steps.
struct Trial {
  std::int64_t steps = 0;               ///< taken
  double time = 0;                      ///< reached [s]
  double step = 0;                      ///< mean of the last quarter of the steps [s]
  double earlier = 0;                   ///< mean of the quarter before [s]
  double step_seconds = 0;              ///< mean wall time of the last half of the steps [s]
  bool over = false;                    ///< the end of the run was reached
  std::optional<Failure> failure = {};  ///< of the last step
};

/// Length of a trial.
struct TrialLimits {
  std::int64_t fewest = 60;  ///< steps, after which step limits have been measured in motion
  std::int64_t most = 400;   ///< steps
  double seconds = 2;        ///< wall time after which `fewest` are enough [s]
  double longest = 10;       ///< wall time after which any number is enough [s]
};

/// Takes the first steps of a run, without output. The state of the formulation is that after these steps. Physical
/// failures are returned in the result, not thrown.
Trial take_trial_steps(Formulation& formulation, RunSpec const& run, TrialLimits const& limits);

}  // namespace piola
