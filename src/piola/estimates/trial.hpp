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
  bool over = false;                    ///< the end of the run was reached
  std::optional<Failure> failure = {};  ///< of the last step
};

/// Takes the first steps of a run, at most `most` and for about `seconds` of wall time, without output. The state of
/// the formulation is that after these steps. Physical failures are returned in the result, not thrown.
Trial take_trial_steps(Formulation& formulation, RunSpec const& run, std::int64_t most, double seconds);

}  // namespace piola
