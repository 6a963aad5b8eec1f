// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/bench/bench_support.hpp"
#include <string>
#include <vector>

namespace piola {

struct TaylorBenchOptions {
  int plate_side = 320;  ///< particles per side of the plate
  int cube_side = 40;
  int bar_particles = 100000;
  int repeats = 8;  ///< time steps per measurement of a step alone; the fastest counts
  int steps = 60;   ///< of the deforming plate, all measured
  std::vector<int> threads{1, 2};
  std::string backend = "auto";  ///< instruction set that is compared with the scalar path
};

/// Whole time steps of one body.
struct TaylorBenchRow : RateRow {
  long list_updates = 0;  ///< in the steps measured
};

/// Cost of the deforming plate in addition to its steps, on one thread [s of CPU time].
struct TaylorUpkeep {
  long particles = 0, cells = 0;
  double step = 0, list_update = 0, triangulation = 0;
  static constexpr int between = 20;  ///< steps from one triangulation to the next in the rate below
  /// Particle-steps per second if lists and cells are rebuilt every `between` steps.
  double per_cpu_second() const {
    return static_cast<double>(particles) / (step + (list_update + triangulation) / between);
  }
};

struct TaylorBenchReport {
  std::string backend;  ///< instruction set that "auto" found
  int lanes = 1;
  std::vector<TaylorBenchRow> rows;
  TaylorUpkeep upkeep;
};

/// Measures inside the real solver, cubic spline, linear elastic, double, whole steps (both halves):
///  - a plate in the fixed configuration and moving, a bar, a cube: the fastest step;
///  - the plate in shear waves that strain it by more than a tenth: all steps, list updates included;
///  - the scalar path for comparison;
///  - the cost of a list update and of the Delaunay triangulation of the deformed plate.
/// Throws InputError if the instruction set is unknown or not usable here.
TaylorBenchReport bench_taylor_sph(TaylorBenchOptions const& options);

std::string to_json(TaylorBenchReport const& report);
std::string to_text(TaylorBenchReport const& report);

}  // namespace piola
