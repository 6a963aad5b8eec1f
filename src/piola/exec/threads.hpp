// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace piola::exec_host {

/// Sets the number of threads of all later loops; 0: automatic_threads(). Returns the number.
int set_threads(int threads);
int threads();

/// How many threads a run takes whose case does not say: OMP_NUM_THREADS if it is set, else SLURM_CPUS_PER_TASK if that
/// is set, else one for each core that this process may use; the latter two at most as many as the control group of
/// the process has processor time for.
int automatic_threads();

/// Threads for a loop over so many particles: at most threads(), and each has at least the least share to work on.
int team(int particles);
/// Sets the least share of a thread [particles] and returns the one before. Its default is the number from which a
/// thread is worth its start and its barrier; tests take 1 so that small bodies are shared by all threads.
int set_least_share(int particles);

/// Pins each thread to one of the cores that this process may use (benchmarks).
void pin_threads();

}  // namespace piola::exec_host
