// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/point3.hpp"
#include <array>
#include <cmath>

/// Arithmetic of points and directions with three components, for pictures.
namespace piola {

inline double dot(Point3 const& a, Point3 const& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point3 minus(Point3 const& a, Point3 const& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
/// a + s b
inline Point3 plus(Point3 const& a, double s, Point3 const& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
inline Point3 cross(Point3 const& a, Point3 const& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(Point3 const& a) { return std::sqrt(dot(a, a)); }
inline double distance(Point3 const& a, Point3 const& b) { return length(minus(a, b)); }
/// Unit vector along `a`; zero for a = 0.
inline Point3 unit(Point3 const& a) {
  double const size = length(a);
  return size > 0 ? Point3{a[0] / size, a[1] / size, a[2] / size} : a;
}
/// Cosine of the angle between the normals of two facets, 55 degrees, above which their common edge is drawn sharp.
inline constexpr double cosine_of_edge = 0.574;
inline bool finite(Point3 const& a) { return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]); }

}  // namespace piola
