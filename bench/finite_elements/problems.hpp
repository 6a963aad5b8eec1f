// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "mesh.hpp"
#include <functional>
#include <string>

namespace bricks {

/// What is read off the curve of one traced number.
enum class Statistic { first_peak, time_of_first_peak, largest, time_of_largest, at_time };

struct Reading {
  std::string name, unit;
  std::size_t traced = 0;  ///< which of the traced numbers
  Statistic take = Statistic::at_time;
  double time = 0;   ///< s, for at_time
  double scale = 1;  ///< of the unit in SI
};

/// One of the published examples, in SI units.
struct Problem {
  std::string name, about;
  Box box;
  Material material;
  double end = 0;     ///< s
  double sample = 0;  ///< s between the samples of a curve, as in the case's history
  std::function<std::array<std::ptrdiff_t, 3>(std::ptrdiff_t)> cells;               ///< of the number across
  std::function<std::array<double, 3>(std::array<double, 3> const&)> velocity;      ///< at the start, of X
  std::function<std::array<double, 3>(std::array<double, 3> const&)> displacement;  ///< at the start; nothing: none
  std::function<unsigned(std::array<double, 3> const&)> held;                       ///< bits 1, 2, 4: x, y, z, of X
  std::function<std::vector<double>(Mesh const&)> trace;                            ///< one row of the curves
  bool angle = false;  ///< the traced number is an angle that may pass half a turn
  std::vector<Reading> readings;
};

std::vector<Problem> problems();

}  // namespace bricks
