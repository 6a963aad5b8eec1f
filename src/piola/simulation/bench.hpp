// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace piola {

struct BenchOptions {
  int particles_per_side = 64;
  int repeats = 8;  ///< time steps per measurement; the fastest counts
  std::vector<int> threads{1, 2};
  std::string machine = "auto";  ///< instruction set beside which the scalar path is measured
};

/// One measurement: whole time steps of a free, slowly spinning cube.
struct BenchRow {
  std::string name;     ///< what was measured
  std::string machine;  ///< instruction set
  int threads = 1;
  double neighbours = 0;             ///< per particle, mean
  double bytes_per_particle = 0;     ///< memory
  double stages_per_second = 0;      ///< particle-stages per second of wall time, threads pinned
  double stages_per_cpu_second = 0;  ///< per second of processor time, times threads: undisturbed by other programs
  double roofline_fraction = 0;      ///< of the smaller of both bounds below, on the CPU-time figure; 0: not defined
};

struct BenchReport {
  long particles = 0;
  std::string machine;        ///< instruction set that "auto" found
  double fma_per_second = 0;  ///< vector multiply-adds per second and core
  int lanes = 1;
  double copy_bytes_per_second = 0;  ///< read + written, one core
  double operations_per_pair = 0;    ///< vector operations per pair and stage, both sweeps (bench/README.md)
  double bytes_per_stage = 0;        ///< bytes moved per particle and stage with perfect reuse of neighbours
  double arithmetic_bound = 0, memory_bound = 0;  ///< particle-stages per second and core
  std::vector<BenchRow> rows;
};

/// Full right-hand side of {p,F} JST-SPH inside the real solver: `paper` supports (about 54 neighbours), both Laplacian
/// sweeps, projections, cubic spline, neo-Hookean, double.
BenchReport bench_jst_sph(BenchOptions const& options);

std::string to_json(BenchReport const& report);
std::string to_text(BenchReport const& report);

}  // namespace piola
