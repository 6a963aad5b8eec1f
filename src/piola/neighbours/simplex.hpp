// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include "piola/neighbours/mesh_cells.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

/// Measures of one simplex: `corner` points to dimension + 1 positions in `points`; in 2D the third components count as
/// zero.
namespace piola {

/// The edge from one point to another, without the components that do not exist.
inline Vec<3> edge_between(Points const& points, Index from, Index to, int dimension) {
  auto const &a = points[static_cast<std::size_t>(from)], &b = points[static_cast<std::size_t>(to)];
  return {{b[0] - a[0], dimension > 1 ? b[1] - a[1] : 0, dimension > 2 ? b[2] - a[2] : 0}};
}

/// Signed volume [m^dimension].
inline double simplex_volume(Points const& points, Index const* corner, int dimension) {
  Vec<3> const a = edge_between(points, corner[0], corner[1], dimension);
  if (dimension == 1) return a[0];
  Vec<3> const b = edge_between(points, corner[0], corner[2], dimension);
  if (dimension == 2) return (a[0] * b[1] - a[1] * b[0]) / 2;
  return dot(cross(a, b), edge_between(points, corner[0], corner[3], dimension)) / 6;
}

inline double longest_edge(Points const& points, Index const* corner, int dimension) {
  double longest = 0;
  for (int j = 1; j <= dimension; ++j)
    for (int i = 0; i < j; ++i) {
      Vec<3> const e = edge_between(points, corner[i], corner[j], dimension);
      longest = std::max(longest, dot(e, e));
    }
  return std::sqrt(longest);
}

/// Centre of the circle or sphere through the corners, seen from the first one [m]; infinitely far if they are on a
/// line (in a plane).
inline Vec<3> circumcentre(Points const& points, Index const* corner, int dimension) {
  Vec<3> const a = edge_between(points, corner[0], corner[1], dimension);
  if (dimension == 1) return 0.5 * a;
  Vec<3> const b = edge_between(points, corner[0], corner[2], dimension);
  Vec<3> const c = dimension == 2 ? Vec<3>{{0, 0, 1}} : edge_between(points, corner[0], corner[3], dimension);
  double const determinant = dot(cross(a, b), c);
  constexpr double far = std::numeric_limits<double>::infinity();
  if (determinant == 0) return {{far, far, far}};
  // At equal distance from all corners: 2 a . centre = a . a, and so on; in 2D the centre stays in the plane.
  double const last = dimension == 2 ? 0 : dot(c, c);
  return (0.5 / determinant) * (dot(a, a) * cross(b, c) + dot(b, b) * cross(c, a) + last * cross(a, b));
}

inline double circumradius(Points const& points, Index const* corner, int dimension) {
  Vec<3> const centre = circumcentre(points, corner, dimension);
  return std::sqrt(dot(centre, centre));
}

}  // namespace piola
