// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace piola::exec_host {

/// Sets the number of threads of all later loops; 0: automatic_threads(). Returns the number.
int set_threads(int threads);
int threads();

/// Default number of threads: OMP_NUM_THREADS if set, else SLURM_CPUS_PER_TASK if set, else the number of cores that
/// this process may use. The latter two are capped by the quota of the control group (processor_quota()).
int automatic_threads();

/// Number of threads for a loop over `particles` particles: at most threads(), each with at least the minimum grain
/// size (set_min_grain_size()).
int team_size(int particles);
/// Sets the least number of particles per thread and returns the previous one. Below the default, a thread costs more
/// (start, barrier) than it saves. Tests set 1 so that all threads work on small bodies.
int set_min_grain_size(int particles);

/// Pins each thread to one of the cores that this process may use (benchmarks).
void pin_threads();

}  // namespace piola::exec_host
