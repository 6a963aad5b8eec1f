// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/estimates/cost_meter.hpp"
#include "piola/estimates/trial.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/particles/particle_set.hpp"
#include "piola/simulation/build.hpp"
#include <cstdint>
#include <utility>
#include <vector>

namespace piola {

/// Cost estimate of a run. Times and memory are those that set-up and trial steps take on this computer, for any
/// formulation; a loaded computer gives longer times.
struct Estimate {
  StepEstimate rule;             ///< without run.max_step
  double step = 0;               ///< s, once the run has settled
  std::int64_t steps = 0;        ///< with a gentle start
  std::int64_t most_steps = 0;   ///< if the step shrinks as far as known cases do; else `steps`
  std::string varies = {};       ///< why `most_steps` is larger, in words
  std::int64_t trial_steps = 0;  ///< steps taken for this estimate; 0: of parts of the bodies only
  bool trial_ends_run = false;   ///< by end or failure of the run: `steps` is exact
  double setup_seconds = 0;      ///< wall time before the first step
  double run_seconds = 0;        ///< wall time of `steps` and of all output
  double most_run_seconds = 0;   ///< wall time of `most_steps` and of all output
  double memory = 0;             ///< largest resident memory [bytes], with set-up and output
  double disk = 0;               ///< frames, pictures, checkpoints and history [bytes]
  int threads = 1;
  double step_seconds = 0;          ///< wall time of a step
  double row_seconds = 0;           ///< wall time of a row of the history
  std::vector<double> distributed;  ///< per body: part of `memory` that ranks divide among themselves [bytes]
};

/// Number of steps of a run of this length.
std::int64_t steps_of(StepEstimate const& rule, RunSpec const& run);

/// Takes trial steps for about two seconds, and returns them with the estimate. `meter`: made before the simulation was
/// built. The state of the simulation is then that after these steps.
std::pair<Estimate, Trial> estimate(Simulation& simulation, CostMeter const& meter);

/// Estimate of a case too large to be built: a small part of each body with the same spacing is built and takes trial
/// steps. It has the same step and, inside, as much memory and time per particle. Contact is not counted. Throws
/// InputError if the formulation rejects the case.
Estimate estimate_from_parts(CaseSpec const& spec, ParticleSet const& particles, int threads);

/// Largest memory of one of `ranks` ranks, that of rank 0 [bytes]. All ranks store the particle sets, and of
/// formulations the local particles and their ghosts.
double memory_of_rank(Estimate const& cost, ParticleSet const& particles, int ranks);

/// Number of particles from which on a case is estimated from parts.
inline constexpr std::int64_t large_case = 200'000;

}  // namespace piola
