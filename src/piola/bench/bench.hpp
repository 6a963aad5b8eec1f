// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace piola {

struct BenchOptions {
  std::filesystem::path cases;     ///< folder with the benchmarks
  std::vector<std::string> names;  ///< benchmarks ("nodal/rates"), or folders of these ("nodal")
  int most_per_side = 0;           ///< larger spacings for cases with more particles than this cubed; 0: as they are
  int repeats = 8;                 ///< measurements of a step; the fastest counts
  std::vector<int> threads{1, 2};  ///< of cases that leave run.threads open
  std::string backend = "auto";    ///< instruction set
};

/// Whole steps of a case, with one instruction set and one number of threads, pinned to one core each.
struct BenchRow {
  std::string bench;    ///< "nodal/rates"
  std::string name;     ///< of the row
  std::string backend;  ///< instruction set
  int threads = 1;
  std::int64_t particles = 0;
  double neighbours = 0;                                  ///< per particle, mean
  double bytes_per_particle = 0;                          ///< memory of the formulation
  int stages = 1;                                         ///< right-hand sides per step
  double set_up = 0;                                      ///< processor time of build() [s]
  double wall = std::numeric_limits<double>::infinity();  ///< wall time of a step [s]
  double cpu = std::numeric_limits<double>::infinity();   ///< processor time of a step, of all threads [s]
  double time_step = 0;                                   ///< mean [s]
  double observation = 0;    ///< wall time of one evaluation of the integral quantities, for a row of the history [s]
  double relative_cost = 1;  ///< processor time per stage and particle over that of the first row of the benchmark
  /// Fractions of the wall time of steps in the parts that the formulation times; of the set-up, if it times only that.
  std::vector<std::pair<std::string, double>> parts;

  double stages_per_second() const { return static_cast<double>(stages * particles) / wall; }
  double stages_per_cpu_second() const { return static_cast<double>(stages * particles) / cpu; }
};

/// Measures the rows of benchmarks. A benchmark is a folder with a case.toml and a rows.toml (bench/README.md): each
/// row changes the case and is run by read_case(), build() and Formulation::step(). Throws InputError: unknown names, a
/// benchmark or instruction set that is not usable; PhysicsError: a row fails.
std::vector<BenchRow> measure_steps(BenchOptions const& options);

std::string to_json(std::vector<BenchRow> const& rows);
std::string to_text(std::vector<BenchRow> const& rows);

}  // namespace piola
