// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/camera_view.hpp"
#include "piola/drawing/point3.hpp"
#include <span>
#include <vector>

/// Pictures of axisymmetric bodies, whose particles lie in a half section: x >= 0 is the radius, y runs along the axis.
/// A section is swept through an angle [deg], from the x axis away from z. Angle 0: the section and its mirror image in
/// the plane.
namespace piola {

inline constexpr double degrees_per_segment = 5;  ///< of surfaces, at most

/// Rotates a point of the section about the axis: (x cos a, y, -x sin a).
struct Rotation {
  double cosine = 1, sine = 0;
  static Rotation by(double degrees);
  Point3 operator()(Point3 const& p) const { return {cosine * p[0], p[1], -sine * p[0]}; }
  /// A direction in space as components along the rotated axes of the section.
  Point3 seen_from_section(Point3 const& a) const {
    return {cosine * a[0] - sine * a[2], a[1], sine * a[0] + cosine * a[2]};
  }
};

/// Distance from the axis below which corners of a body's outline are put on it [m]. A skin reaches the surface of a
/// shape within 1e-3 spacings; where packed bodies have a corner on the axis, within a fraction of a spacing.
double width_of_axis(std::span<Point3 const> reference, double spacing);

/// Angles [deg] at most `step` apart with both ends of the sweep; 0 and 180 for angle 0.
std::vector<double> angles_of_sweep(double degrees, double step);

/// Particles of sections as they lie in space, for fitting a window.
struct RevolvedPoints {
  std::vector<Point3> points;
  std::vector<double> volume;
  std::vector<int> body;
};
RevolvedPoints revolved(Subject const& section, double degrees);

/// Radius of the ball of each particle, see ball_radii. The section of a ring is its volume over its circle; the
/// largest tenth does not count, as near the axis the quotient is uncertain. `X`: reference positions.
std::vector<double> ball_radii_of_rings(std::span<double const> volume, std::span<Point3 const> X,
                                        std::span<int const> body);

}  // namespace piola
