// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/expression.hpp"
#include <array>
#include <string>

namespace piola {

/// A rigid obstacle that bodies slide on without friction.
struct RigidShape {
  enum class Kind { plane, sphere, cylinder, box };
  std::string name;
  Kind kind = Kind::plane;
  std::array<double, 3> centre{};        ///< of sphere, cylinder and box; a point of the plane [m]
  std::array<double, 3> axis{0, 0, 1};   ///< unit vector: plane: outward normal, towards the bodies; cylinder: its axis
  std::array<double, 3> half_lengths{};  ///< box: half its edges; cylinder: half its length in the first [m]
  double radius = 0;                     ///< sphere, cylinder [m]
  std::array<Expression, 3> velocity;    ///< prescribed, in t [m/s]
};

}  // namespace piola
