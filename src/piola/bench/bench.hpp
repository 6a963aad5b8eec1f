// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <string>
#include <vector>

namespace piola {

struct BenchOptions {
  bool rates = true, column = true, variables = true;  ///< selected measurements
  int particles_per_side = 64;
  std::array<int, 3> column_particles{26, 157, 26};
  int column_settling = 50;  ///< steps before the measurement: the first ones are short
  int column_steps = 50;     ///< measured steps: with one measurement of the step limit
  int repeats = 8;           ///< time steps per measurement; the fastest counts
  std::vector<int> threads{1, 2};
  std::string backend = "auto";  ///< instruction set that is compared with the scalar path
};

/// One measurement: whole time steps of a free, slowly spinning body.
struct BenchRow {
  std::string name;     ///< name of the measurement
  std::string backend;  ///< instruction set
  int threads = 1;
  long particles = 0;
  double neighbours = 0;             ///< per particle, mean
  double bytes_per_particle = 0;     ///< memory
  double stages_per_second = 0;      ///< particle-stages per second of wall time, threads pinned
  double stages_per_cpu_second = 0;  ///< per second of processor time, times threads: undisturbed by other programs
  double roofline_fraction = 0;      ///< of the smaller of both bounds below, on the CPU-time figure; 0: not defined
};

/// Simulated time of the twisting column per second of CPU time, one thread, without set-up.
struct ColumnRow {
  std::string name;
  double neighbours = 0;  ///< per particle, mean
  int steps = 0;
  double simulated = 0;  ///< s
  double cpu = 0;        ///< s
  double milliseconds_per_cpu_second() const { return 1e3 * simulated / cpu; }
};

/// Right-hand sides with one choice of evolved variables, one thread; all choices alternate in the same run.
struct VariablesRow {
  std::string name;
  double neighbours = 0;                  ///< per particle, mean
  double right_sides_per_cpu_second = 0;  ///< of one particle
  double relative_cost = 1;               ///< time per right-hand side over that of the first row
};

struct BenchReport {
  long particles = 0, column_particles = 0, variables_particles = 0;
  std::string backend;        ///< instruction set that "auto" found
  double fma_per_second = 0;  ///< vector multiply-adds per second and core
  int lanes = 1;
  double copy_bytes_per_second = 0;  ///< read + written, one core
  double operations_per_pair = 0;    ///< vector operations per pair and stage, both sweeps (bench/README.md)
  double bytes_per_stage = 0;        ///< bytes moved per particle and stage with perfect reuse of neighbours
  double arithmetic_bound = 0, memory_bound = 0;  ///< particle-stages per second and core
  std::vector<BenchRow> rows;
  std::vector<ColumnRow> column;
  std::vector<VariablesRow> variables;
};

/// Measures inside the real solver, cubic spline, neo-Hookean, double:
///  - rates: the full right-hand side of {p,F} JST-SPH, `paper` supports (about 54 neighbours), both Laplacian sweeps,
///    projections;
///  - column: simulated time per CPU time of the twisting column with the default scheme;
///  - variables: the cost of the filter and of evolved J and H compared with plain {p,F}.
BenchReport bench_jst_sph(BenchOptions const& options);

std::string to_json(BenchReport const& report);
std::string to_text(BenchReport const& report);

}  // namespace piola
