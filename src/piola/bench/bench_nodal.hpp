// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/bench/bench_support.hpp"
#include <string>
#include <vector>

namespace piola {

struct NodalBenchOptions {
  bool rates = true, set_up = true;            ///< selected measurements
  int cube_side = 60;                          ///< particles per side of the cube on a lattice
  int cloud_side = 40;                         ///< of the jittered cube
  std::vector<int> lengths{40, 80, 160, 320};  ///< lengths of jittered columns 5 x 5 whose set-up is measured
  int repeats = 8;                             ///< time steps per measurement; the fastest counts
  std::vector<int> threads{1, 2};
  std::string backend = "auto";  ///< instruction set that is compared with the scalar path
};

/// Setting up one body on one thread, the fastest of a few times [s].
struct NodalSetUpRow {
  std::string name;
  long particles = 0;
  double cells = 0, fits = 0, integration_correction = 0, masses = 0, tables = 0;
  int iterations = 0;     ///< of the solve for the divergence theorem
  int tight = 0;          ///< iterations to 1e-6 of the first residual; 0: not measured
  double right_side = 0;  ///< one right-hand side of the body
  double total() const { return cells + fits + integration_correction + masses + tables; }
};

struct NodalBenchReport {
  std::string backend;  ///< instruction set that "auto" found
  int lanes = 1;
  std::vector<RateRow> rows;  ///< particle-stages
  std::vector<NodalSetUpRow> set_up;
};

/// Measures inside the real solver, neo-Hookean rubber, double:
///  - rates: whole steps of given length (both sweeps, points, Verlet) of a large cube and of the small columns of the
///    examples, on a lattice and on jittered clouds, compared with the scalar path;
///  - set_up: its cost by parts, compared with one right-hand side; also for long jittered columns.
/// Throws InputError if the instruction set is unknown or not usable here.
NodalBenchReport bench_nodal(NodalBenchOptions const& options);

std::string to_json(NodalBenchReport const& report);
std::string to_text(NodalBenchReport const& report);

}  // namespace piola
