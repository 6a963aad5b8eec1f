// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace piola {

/// A straight spring and dashpot between points of two rigid shapes, or of one and a point at rest. Its force along the
/// line between the points is stiffness (length - rest_length) + damping d(length)/dt, positive in tension.
struct RigidSpring {
  using Point = std::array<double, 3>;
  std::string name;
  std::size_t first = 0;              ///< number of the rigid shape
  std::optional<std::size_t> second;  ///< empty: a point at rest
  std::array<Point, 2> points{};      ///< places of its ends at the start [m]
  double stiffness = 0;               ///< [N/m]; in 2D per length [N/m2]
  double damping = 0;                 ///< [N s/m]; in 2D per length [N s/m2]
  double rest_length = 0;             ///< [m]
};

}  // namespace piola
