// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/expression.hpp"
#include <array>
#include <optional>
#include <string>

namespace piola {

/// A rigid shape: an obstacle at rest or driven, or a free body that moves by contact, forces and springs.
struct RigidShape {
  enum class Kind { plane, sphere, cylinder, box };
  using Point = std::array<double, 3>;
  std::string name;
  Kind kind = Kind::plane;
  Point centre{};        ///< of sphere, cylinder and box; for a plane: a point on it [m]
  Point axis{0, 0, 1};   ///< unit vector: plane: outward normal, towards the bodies; cylinder: its axis
  Point half_lengths{};  ///< box: half its edges; cylinder: half its length in the first [m]
  double radius = 0;     ///< sphere, cylinder [m]
  /// Prescribed as functions of t; for a free body: values at the start [m/s], [rad/s], about the centre.
  std::array<Expression, 3> velocity, angular_velocity;
  std::array<Point, 3> edges{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< box: unit vectors along its edges

  bool free = false;  ///< false: motion as prescribed
  double mass = 0;    ///< free [kg]; in 2D per length [kg/m]
  /// Inertia of a free body: XX YY ZZ XY YZ XZ about the centre at the start [kg m2]; in 2D ZZ alone, per length [kg
  /// m]. Empty: of the homogeneous shape.
  std::optional<std::array<double, 6>> inertia;
  std::array<Expression, 3> gravity;  ///< of a free body: acceleration as a function of t [m/s2]
  /// Force on the centre of a free body [N] and torque about it [N m], as functions of t; in 2D per length.
  std::array<Expression, 3> force, torque;
  enum class TorqueAxes { space, body };
  TorqueAxes torque_axes = TorqueAxes::space;  ///< body: they rotate with the body, and are x, y, z at the start
  std::array<bool, 3> held{};                  ///< of a free body: directions in which it keeps its initial velocity
  bool can_turn = true;                        ///< of a free body

  /// Whether it rotates, or may rotate by contact.
  bool turns() const {
    bool driven = false;
    for (Expression const& component : angular_velocity) driven = driven || component.text() != "0";
    return free || driven;
  }
};

}  // namespace piola
