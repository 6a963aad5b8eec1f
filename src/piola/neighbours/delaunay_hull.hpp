// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/neighbours/mesh_cells.hpp"
#include <string>

/// The only file that uses Qhull.
namespace piola {

/// Simplices between points, from the lower side of the convex hull of the points lifted by one dimension.
struct LowerHull {
  std::vector<Index> corner;  ///< dimension + 1 per simplex, in any order
  std::string trouble;        ///< message of Qhull if it failed; empty otherwise
};

/// `height`: per point, its coordinate in the additional dimension. Facets with more corners than a simplex (four
/// points at the same height over a plane, to rounding) are cut into simplices so that adjacent facets conform.
/// Coordinates and heights should be of order one.
LowerHull lower_hull(Points const& points, std::vector<double> const& height, int dimension);

}  // namespace piola
