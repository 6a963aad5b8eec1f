// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/neighbours/mesh_cells.hpp"

namespace piola {

/// The box around points.
struct Extent {
  std::array<double, 3> centre{}, size{};  ///< [m]; zero in dimensions that do not exist
  double half_diagonal = 0;                ///< [m]
};

Extent extent_of(Points const& points, int dimension);

/// Throws InputError with every reason for which there are no cells between these points: too few, not finite, two at
/// one place, all on a line (in a plane).
void check_points(Points const& points, int dimension);

}  // namespace piola
