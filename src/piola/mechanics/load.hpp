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

/// Dashpots on a non-reflecting patch, in units of the impedances of the material.
struct Absorption {
  std::array<double, 2> impedance{1, 1};  ///< along the normal: rho c_p; across it: rho c_s
  std::optional<double> angle = {};       ///< to the normal, of pressure waves that leave no reflection, instead [rad]
};

/// A dead load: accelerates particle k by value(X, t) * factor[k].
struct Load {
  std::vector<std::int64_t> particles;  ///< ids
  std::vector<double> factor;  ///< traction [Pa]: area / mass; force per volume [N/m^3]: 1 / density; acceleration: 1
  std::array<Expression, 3> value;
  double until = std::numeric_limits<double>::infinity();  ///< end of the load [s]
  /// Outward unit normal of the loaded face in the reference configuration, if the load is a traction.
  std::optional<std::array<double, 3>> normal = {};
  std::vector<std::array<double, 3>> normals = {};  ///< as `normal`, per particle, for curved faces
  int patch = -1;            ///< number of the loaded patch of the surface, see Outline::patches; -1: none
  bool whole_patch = false;  ///< the load acts on all of it
  bool pressure = false;     ///< the value's first component is a pressure [Pa] on that face
  bool follows = false;      ///< follower load: a pressure on the deformed face, along its
                             ///< current normal
  std::optional<Absorption> absorbs = {};  ///< a non-reflecting patch: `value` is the background velocity [m/s]
  std::string name = {};                   ///< empty: its force is not recorded
  std::array<double, 3> about{};  ///< reference point of its moment: the mean position of its particles at the start
                                  ///< [m]

  bool on_face() const { return normal.has_value() || !normals.empty(); }
  /// Outward unit normal of the face at particle k.
  std::array<double, 3> normal_of(std::size_t k) const { return normals.empty() ? *normal : normals[k]; }
};

}  // namespace piola
