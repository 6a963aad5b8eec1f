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

/// Particles whose velocity is prescribed in some directions: zero or `velocity`.
struct Support {
  enum class Frame {
    axes,    ///< the directions in `fix`
    normal,  ///< along `normal`: a roller on an oblique plane
    tangent  ///< across `normal`: the particle may move only along the normal
  };
  std::vector<std::int64_t> particles;  ///< ids
  std::array<bool, 3> fix{};
  Frame frame = Frame::axes;
  std::array<double, 3> normal{};                          ///< unit vector
  std::optional<std::array<Expression, 3>> velocity;       ///< m/s, in X, Y, Z, t; nothing: at rest
  double until = std::numeric_limits<double>::infinity();  ///< time of release [s]
  std::string name = {};
  std::array<double, 3> about{};  ///< reference point of its moment: the mean position of its particles at the start
                                  ///< [m]
  /// Outward normals of the face at the particles, if the face itself is held instead of the particles.
  std::vector<std::array<double, 3>> normals = {};

  bool on_surface() const { return !normals.empty(); }
};

}  // namespace piola
