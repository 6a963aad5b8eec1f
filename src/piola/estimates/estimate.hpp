// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/estimates/trial.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/particles/particle_set.hpp"
#include "piola/simulation/build.hpp"
#include <cstdint>
#include <optional>
#include <vector>

namespace piola {

/// Cost estimate of a run. Work is counted, not timed: the result is independent of the load of the machine. Times are
/// for the processor of `bench/README.md`; bytes are measured.
struct Estimate {
  StepEstimate rule;             ///< without run.max_step
  double step = 0;               ///< s, once the run has settled
  std::int64_t steps = 0;        ///< with a gentle start
  std::int64_t most_steps = 0;   ///< if the step shrinks as far as known cases do; else `steps`
  std::string varies = {};       ///< why `most_steps` is larger, in words
  std::int64_t trial_steps = 0;  ///< steps taken for this estimate
  bool trial_ends_run = false;   ///< by end or failure of the run: `steps` is exact
  double setup_seconds = 0;      ///< wall time before the first step
  double run_seconds = 0;        ///< wall time of `steps` and of all output
  double most_run_seconds = 0;   ///< wall time of `most_steps` and of all output
  double memory = 0;             ///< largest resident memory [bytes], with set-up and output
  double disk = 0;               ///< frames, pictures, checkpoints and history [bytes]
  int threads = 1;
  double busy_threads = 1;                       ///< threads of a loop over particles
  double stages = 0;                             ///< right-hand sides per step, on average
  double step_work = 0;                          ///< CPU time of a step [s]
  double row_work = 0;                           ///< CPU time of a row of the history [s]
  double row_work_of_first = 0;                  ///< part of row_work on rank 0 alone [s]
  double row_bytes = 0;                          ///< gathered on rank 0 for a row
  double rows_per_step = 0;                      ///< rows of the history per step
  double memory_everywhere = 0;                  ///< part of `memory` that is replicated on every rank [bytes]
  double memory_in_steps = 0;                    ///< `memory` without temporary memory of set-up and output
  double memory_in_set_up = 0;                   ///< largest of one rank before the first step
  double everywhere_in_set_up = 0;               ///< part of memory_in_set_up that is replicated on every rank
  double memory_of_first = 0;                    ///< needed by rank 0 for output of all particles
  std::vector<std::optional<CommPattern>> talk;  ///< per body
};

/// Number of steps of a run of this length, from the first one on, or from `time` [s] on after a step `last` [s].
std::int64_t steps_of(StepEstimate const& rule, RunSpec const& run);
std::int64_t steps_of(StepEstimate const& rule, RunSpec const& run, double time, double last);

/// Estimate of a case whose formulation is built.
Estimate estimate(CaseSpec const& spec, ParticleSet const& particles, Formulation const& formulation, int threads);

/// As above, corrected by trial steps for about two seconds. The state of the simulation is then that after these
/// steps.
Estimate estimate_by_trial(Simulation& simulation, Trial& trial);

/// Estimate of a case too large to be built: of each body a small part with the same spacing is built, which has the
/// same step and, inside, as much memory per particle. Throws InputError if the formulation rejects the case.
Estimate estimate_from_parts(CaseSpec const& spec, ParticleSet const& particles, int threads);

/// Number of particles from which on a case is estimated from parts.
inline constexpr std::int64_t large_case = 200'000;

}  // namespace piola
