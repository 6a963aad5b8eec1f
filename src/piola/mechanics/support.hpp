// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/expression.hpp"
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace piola {

/// Particles whose velocity is prescribed in some directions: at zero, or as `velocity` says.
struct Support {
  enum class Frame {
    axes,    ///< the directions in `fix`
    normal,  ///< along `normal`: a roller on an oblique plane
    tangent  ///< across `normal`: the particle may move along the normal alone
  };
  std::vector<std::int64_t> particles;  ///< ids
  std::array<bool, 3> fix{};
  Frame frame = Frame::axes;
  std::array<double, 3> normal{};                          ///< unit vector
  std::optional<std::array<Expression, 3>> velocity;       ///< m/s, in X, Y, Z, t; nothing: at rest
  double until = std::numeric_limits<double>::infinity();  ///< s: released then
  std::string name = {};
  std::array<double, 3> about{};  ///< point of its moment: the middle of its particles at the start [m]
  /// Outward normals of the face at the particles, if the face itself is held and not the particles along it.
  std::vector<std::array<double, 3>> normals = {};

  bool on_surface() const { return !normals.empty(); }
};

}  // namespace piola
