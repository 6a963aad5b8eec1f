// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/particles/particle_set.hpp"
#include "piola/simulation/build.hpp"
#include "piola/simulation/trial.hpp"
#include <cstdint>
#include <optional>
#include <vector>

namespace piola {

/// What a run would take. Work is counted, not timed: the same case gives the same answer on an idle and on a busy
/// machine. Times are those of the processor that `bench/README.md` speaks of; bytes are measured ones.
struct Estimate {
  StepRule rule;                 ///< without run.max_step
  double step = 0;               ///< s, once the run has settled
  std::int64_t steps = 0;        ///< with a gentle start
  std::int64_t most_steps = 0;   ///< the same where the step shrinks as far as it is known to; else `steps`
  std::string varies = {};       ///< why `most_steps` are more, in words
  std::int64_t trial_steps = 0;  ///< steps that were really taken for this estimate
  bool trial_ends_run = false;   ///< at its end or by a failure: the steps are exact
  double setup_seconds = 0;      ///< wall time before the first step
  double run_seconds = 0;        ///< wall time of `steps` and of all output
  double most_run_seconds = 0;   ///< the same of `most_steps`
  double memory = 0;             ///< largest resident memory [bytes], with set-up and output
  double disk = 0;               ///< frames, pictures, checkpoints and history [bytes]
  int threads = 1;
  double busy_threads = 1;                ///< that share a loop over particles
  double stages = 0;                      ///< right-hand sides of a step, on average
  double step_work = 0;                   ///< processor time of a step [s]
  double row_work = 0;                    ///< of a row of the history [s]
  double row_work_of_first = 0;           ///< of it what rank 0 does alone [s]
  double row_bytes = 0;                   ///< that rank 0 gets of others for it
  double rows_per_step = 0;               ///< of the history
  double memory_everywhere = 0;           ///< of `memory` what every rank has in full [bytes]
  double memory_in_steps = 0;             ///< `memory` without what set-up and output need for a while
  double memory_in_set_up = 0;            ///< the most of one rank before the first step
  double everywhere_in_set_up = 0;        ///< of it what every rank has in full
  double memory_of_first = 0;             ///< what rank 0 needs for output of all particles
  std::vector<std::optional<Talk>> talk;  ///< per body
};

/// Steps that a run of this length takes, from the first one on, or from `time` [s] on after a step `last` [s].
std::int64_t steps_of(StepRule const& rule, RunSpec const& run);
std::int64_t steps_of(StepRule const& rule, RunSpec const& run, double time, double last);

/// Of a case whose formulation is built.
Estimate estimate(CaseSpec const& spec, ParticleSet const& particles, Formulation const& formulation, int threads);

/// The same, corrected by trial steps: as many as about two seconds allow. Afterwards the state of the simulation is
/// that after these steps.
Estimate estimate_by_trial(Simulation& simulation, Trial& trial);

/// Of a case too large to be built for a look: of each body a small part with the same spacing is built, which has the
/// same step and, inside, as much memory per particle. Throws InputError for what the formulation refuses.
Estimate estimate_from_parts(CaseSpec const& spec, ParticleSet const& particles, int threads);

/// From this many particles on a case is estimated from parts.
inline constexpr std::int64_t large_case = 200'000;

}  // namespace piola
