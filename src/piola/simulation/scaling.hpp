// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/particles/particle_set.hpp"
#include "piola/simulation/estimate.hpp"
#include <vector>

/// What a run would be on several ranks: counted on the particles as they start, and timed by a model. Formulas and
/// what they were measured with: docs/theory/scaling.md.
namespace piola {

/// One rank's part of a run.
struct RankShare {
  std::int64_t particles = 0;
  std::int64_t halo = 0;           ///< particles of other ranks that it reads as neighbours of its own for good
  std::int64_t near = 0;           ///< and because they are near in space, at the start
  double messages = 0, bytes = 0;  ///< that it sends to others in a step, on average
  double memory = 0;               ///< the most that it takes at a time [bytes]
};

/// What connects ranks.
struct Network {
  double latency = 2e-6;    ///< of a message [s]
  double bandwidth = 6e9;   ///< of a rank to all others [bytes/s]
  double packing = 1.5e-9;  ///< processor time to pack a number for a message, and to unpack one [s]
};

/// Wall times of a step of the slowest rank [s].
struct StepTimes {
  double sweeps = 0;       ///< right-hand sides of its particles
  double messages = 0;     ///< packing, sending, waiting: nothing is done meanwhile
  double collectives = 0;  ///< of all ranks
  double rows = 0;         ///< a step's part of the rows of the history, for which rank 0 gets what it has to look at
  double total() const { return sweeps + messages + collectives + rows; }
};

struct Scaling {
  std::vector<RankShare> shares;
  double collectives = 0;  ///< of a step
  double to_all = 0;       ///< bytes of a step that all ranks are told
  StepTimes times;
  double efficiency = 1;  ///< time of one rank with the same threads, by the number of ranks and their time
};

/// Whether all of the bodies can be shared.
bool runs_on_ranks(Estimate const& cost);
/// On so many ranks. `cost`: of the case on one rank, all of whose bodies run on ranks. Threads are those of a rank.
Scaling scale(ParticleSet const& particles, Estimate const& cost, int ranks, Network const& network = {});
/// The most ranks, of powers of two up to `most`, half of whose time or more is that of one rank shared out.
int ranks_that_pay(ParticleSet const& particles, Estimate const& cost, int most, Network const& network = {});

}  // namespace piola
