// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <string>

namespace piola {

/// Pose and motion of a free or rotating rigid shape.
struct RigidState {
  std::string name;
  std::array<double, 3> centre{};            ///< m
  std::array<double, 3> velocity{};          ///< of the centre, m/s
  std::array<double, 3> turn{};              ///< rotation vector since the start [rad]
  std::array<double, 3> angular_velocity{};  ///< rad/s
  double kinetic_energy = 0;                 ///< of a free shape, J
  double rotational_energy = 0;              ///< rotational part of kinetic_energy, J
};

}  // namespace piola
