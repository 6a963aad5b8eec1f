// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

/// Common functions of the benchmarks of all formulations.
namespace piola {

double wall_seconds();  ///< since an arbitrary origin [s]
double cpu_seconds();   ///< processor time of all threads of this program [s]

/// The instruction set and, if different and among the usable names (nullptr-terminated), the scalar path.
std::vector<std::string> speedup_over_scalar(std::string const& backend, char const* const* usable);

struct Timing {
  double wall, cpu;  ///< s
};

/// Sets the number of threads of later loops, pinned to one core each.
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
  std::string name;     ///< name of the measurement
  std::string backend;  ///< instruction set
  int threads = 1;
  long particles = 0;             ///< without virtual particles
  double neighbours = 0;          ///< per particle, mean; of real particles: virtual neighbours
  double bytes_per_particle = 0;  ///< memory, virtual particles and lists included
  double per_second = 0;          ///< particles advanced by a step per second of wall time, threads pinned
  double per_cpu_second = 0;      ///< per second of processor time of all threads: undisturbed by other programs

  /// Sets number of particles, memory and rates from a formulation and the time of one step.
  void fill(Formulation const& formulation, std::int64_t count, Timing const& step);
  /// All but the rates.
  nlohmann::ordered_json json() const;
};

}  // namespace piola
