// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/expression.hpp"
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// Particles whose velocity is prescribed in some directions: zero or `velocity`. A new frame: its enumerator, its row
/// in support_frames, and its directions in directions_of().
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
  int patch = -1;            ///< number of that face, see Outline::patches; -1: none
  bool whole_patch = false;  ///< all of it is held

  bool on_surface() const { return !normals.empty(); }
};

/// How cases name a frame. In the order of Support::Frame.
struct SupportFrame {
  std::string_view word;         ///< value of `fix`; empty: letters of axes
  std::string_view preposition;  ///< of the normal in the list of `piola check`
};
inline constexpr std::array support_frames{SupportFrame{"", "in"}, SupportFrame{"normal", "along"},
                                           SupportFrame{"tangent", "across"}};
static_assert(support_frames.size() == static_cast<std::size_t>(Support::Frame::tangent) + 1);

}  // namespace piola
