// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
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

/// Whole time steps of one body.
struct RateRow {
  std::string name;     ///< what was measured
  std::string machine;  ///< instruction set
  int threads = 1;
  long particles = 0;             ///< real ones
  double neighbours = 0;          ///< per particle, mean; of real particles virtual ones
  double bytes_per_particle = 0;  ///< memory, virtual particles and lists included
  double per_second = 0;          ///< particles advanced by a step per second of wall time, threads pinned
  double per_cpu_second = 0;      ///< per second of processor time of all threads: undisturbed by other programs

  /// Number of particles, memory and rates, from a formulation and the time of one of its steps.
  void fill(Formulation const& formulation, std::int64_t count, Timing const& step);
  /// All but the rates.
  nlohmann::ordered_json json() const;
};

}  // namespace piola
