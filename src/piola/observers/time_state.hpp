// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace piola {

/// State of the progress of a run.
struct TimeState {
  double time = 0;                    ///< s
  std::int64_t step = 0;              ///< steps done
  double dt = 0;                      ///< s, the last step
  double first_dt = 0;                ///< s, the first stable step
  bool cut_to_end = false;            ///< the last step was shortened to the end of the run
  bool bounded_by_max_step = false;   ///< the last step was limited by run.max_step, not by the formulation
  bool checkpoint_requested = false;  ///< from outside, after the last step
  bool at_rest = false;               ///< dynamic relaxation converged with the last step
  double wall_seconds = 0;            ///< since the start, over all parts of a resumed run
  double stepping_seconds = 0;        ///< part of wall_seconds inside the formulation
};

/// Outcome of a run.
enum class RunStatus { completed, failed, stopped };

}  // namespace piola
