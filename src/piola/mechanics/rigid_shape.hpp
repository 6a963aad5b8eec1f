// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/expression.hpp"
#include <array>
#include <optional>
#include <string>

namespace piola {

/// A rigid shape: an obstacle that rests or is driven, or a free body that what it touches moves.
struct RigidShape {
  enum class Kind { plane, sphere, cylinder, box };
  using Point = std::array<double, 3>;
  std::string name;
  Kind kind = Kind::plane;
  Point centre{};        ///< of sphere, cylinder and box; a point of the plane [m]
  Point axis{0, 0, 1};   ///< unit vector: plane: outward normal, towards the bodies; cylinder: its axis
  Point half_lengths{};  ///< box: half its edges; cylinder: half its length in the first [m]
  double radius = 0;     ///< sphere, cylinder [m]
  /// Prescribed, in t; of a free body that at the start [m/s], [rad/s] about the centre.
  std::array<Expression, 3> velocity, angular_velocity;
  std::array<Point, 3> edges{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< box: unit vectors along its edges

  bool free = false;  ///< else it moves as prescribed
  double mass = 0;    ///< free [kg]; in 2D per length [kg/m]
  /// Free: XX YY ZZ XY YZ XZ about the centre at the start [kg m2]; in 2D ZZ alone counts, per length [kg m]. Else that
  /// of the homogeneous shape.
  std::optional<std::array<double, 6>> inertia;
  std::array<Expression, 3> gravity;  ///< free: acceleration, in t [m/s2]
  std::array<bool, 3> held{};         ///< free: directions in which it keeps the velocity of the start
  bool can_turn = true;               ///< free

  /// Whether it turns, perhaps as others push it.
  bool turns() const {
    bool driven = false;
    for (Expression const& component : angular_velocity) driven = driven || component.text() != "0";
    return free || driven;
  }
};

}  // namespace piola
