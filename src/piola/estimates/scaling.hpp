// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/estimates/estimate.hpp"
#include "piola/particles/particle_set.hpp"
#include <vector>

/// Predicts a run on several ranks: ghosts counted for the initial positions, times by a model. Formulas and
/// measurements: docs/theory/scaling.md.
namespace piola {

/// The part of one rank in a run.
struct RankLoad {
  std::int64_t particles = 0;
  std::int64_t halo = 0;           ///< ghosts in the reference configuration
  std::int64_t near = 0;           ///< spatial ghosts, at the start
  double messages = 0, bytes = 0;  ///< sent per step, on average
  double memory = 0;               ///< peak memory [bytes]
};

/// Parameters of the network.
struct Network {
  double latency = 2e-6;    ///< per message [s]
  double bandwidth = 6e9;   ///< of a rank to all others [bytes/s]
  double packing = 1.5e-9;  ///< CPU time to pack or unpack a value [s]
};

/// Wall times of a step of the slowest rank [s].
struct StepTimes {
  double sweeps = 0;       ///< right-hand sides of its particles
  double messages = 0;     ///< packing, sending and waiting, without overlap
  double collectives = 0;  ///< over all ranks
  double rows = 0;         ///< a step's part of the rows of the history, whose data are gathered on rank 0
  double total() const { return sweeps + messages + collectives + rows; }
};

struct Scaling {
  std::vector<RankLoad> shares;
  double collectives = 0;        ///< per step
  double replicated_values = 0;  ///< bytes per step that are replicated on all ranks
  StepTimes times;
  double efficiency = 1;  ///< time of one rank with the same threads, over the number of ranks times their time
};

/// Whether all bodies can be distributed over ranks.
bool runs_on_ranks(Estimate const& cost);
/// Prediction for `ranks` ranks. `cost`: of the case on one rank, all of whose bodies run on ranks. Threads are those
/// of a rank.
Scaling scale(ParticleSet const& particles, Estimate const& cost, int ranks, Network const& network = {});
/// The largest power of two up to `most` with a parallel efficiency of at least one half.
int max_efficient_ranks(ParticleSet const& particles, Estimate const& cost, int most, Network const& network = {});

}  // namespace piola
