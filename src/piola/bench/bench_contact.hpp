// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/bench/bench_support.hpp"
#include <string>
#include <vector>

namespace piola {

struct ContactBenchOptions {
  int cube_side = 40;  ///< particles per side of each of the two cubes
  int repeats = 8;     ///< time steps per measurement; the fastest counts
  std::string backend = "auto";
};

/// Whole steps of two cubes, one thread.
struct ContactRow {
  std::string name;         ///< formulation and contact setting
  double microseconds = 0;  ///< CPU time per step
  double share = 0;         ///< additional time over the time without contact
  double step_ratio = 1;    ///< stable step over that without contact
};

struct ContactBenchReport {
  long particles = 0;
  std::vector<ContactRow> rows;
};

/// Two cubes of neo-Hookean rubber, 3D, double, in contact on a whole face: without contact, with surfaces that are far
/// apart, pressed together without and with friction, and with self-contact of each body.
ContactBenchReport bench_contact(ContactBenchOptions const& options);

std::string to_json(ContactBenchReport const& report);
std::string to_text(ContactBenchReport const& report);

}  // namespace piola
