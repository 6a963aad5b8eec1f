// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include <cstdint>
#include <string>
#include <vector>

/// What the benchmarks of all formulations share.
namespace piola {

double wall_seconds();  ///< since some moment [s]
double cpu_seconds();   ///< processor time of all threads of this program [s]

/// The machine and, where it is another one and among the usable names (they end with nullptr), the scalar path.
std::vector<std::string> beside_scalar(std::string const& machine, char const* const* usable);

struct Timing {
  double wall, cpu;  ///< s
};

/// Loops run on this many threads from now on, one per core.
void pin_to(int threads);

/// Takes `steps` steps as long as they are stable; returns the time at their end [s].
double take_steps(Formulation& formulation, double time, int steps);

/// Fastest of several measurements of a whole time step, each the mean of 50 ms or more; one step before them, which is
/// not measured, warms caches and threads.
Timing fastest_step(Formulation& formulation, int repeats);

/// Mean over all particles of the field Neighbours.
double mean_neighbours(Formulation const& formulation, std::int64_t particles);

}  // namespace piola
