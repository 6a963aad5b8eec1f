// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <string>

namespace piola {

/// How a rigid shape that is free, or turns, stands and moves.
struct RigidState {
  std::string name;
  std::array<double, 3> centre{};            ///< m
  std::array<double, 3> velocity{};          ///< of the centre, m/s
  std::array<double, 3> turn{};              ///< since the start, about the axis of this vector by its length [rad]
  std::array<double, 3> angular_velocity{};  ///< rad/s
  double kinetic_energy = 0;                 ///< of a free shape, J
  double rotational_energy = 0;              ///< the part of it that is in the turning, J
};

}  // namespace piola
