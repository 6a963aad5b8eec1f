// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/bench/bench_support.hpp"
#include <string>
#include <utility>
#include <vector>

namespace piola {

struct AdaptleBenchOptions {
  int cube_side = 48;  ///< particles per side; plates have as many particles
  int repeats = 8;     ///< time steps per measurement; the fastest counts
  std::vector<int> threads{1, 2};
  std::string backend = "auto";  ///< instruction set that is compared with the scalar path
};

/// Whole time steps of one body.
struct AdaptleBenchRow : RateRow {
  std::vector<std::pair<std::string, double>> parts;  ///< fraction of the wall time of a step
};

struct AdaptleBenchReport {
  std::string backend;  ///< instruction set that "auto" found
  int lanes = 1;
  std::vector<AdaptleBenchRow> rows;
};

/// Measures inside the real solver: one force evaluation per step, double precision, perfectly plastic, viscosity,
/// lists rebuilt in every step. Cubes and plates with jittered particles that are Eulerian, total-Lagrangian, and half
/// and half; the Eulerian cube also with the mixed correction and with artificial stress. Each with the scalar path for
/// comparison. Throws InputError if the instruction set is unknown or not usable here.
AdaptleBenchReport bench_adaptle(AdaptleBenchOptions const& options);

std::string to_json(AdaptleBenchReport const& report);
std::string to_text(AdaptleBenchReport const& report);

}  // namespace piola
