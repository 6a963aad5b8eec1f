// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/picture.hpp"
#include "piola/drawing/vector_math.hpp"
#include <array>

/// Projection from metres to pixels, common to all parts of a picture.
namespace piola {

/// A line of sight; `towards` the viewer has length 1.
struct ViewRay {
  std::array<double, 3> from, towards;
};

/// Parallel projection: pixels = shift + scale * metres, y downwards; depth grows towards the viewer. A picture in
/// perspective is the parallel projection of bodies that Eye::seen has moved.
struct Projection {
  std::array<double, 3> right, up, towards;
  double scale = 1, x_shift = 0, y_shift = 0;
  Eye eye = {};

  /// The line that is seen in a pixel, before anything was moved.
  ViewRay sight(double x, double y) const {
    Point3 const there = point(x, y);
    if (!eye.near()) return {there, towards};
    Point3 const from = plus(there, -eye.height(there), towards);
    return {from, unit(minus(plus(eye.axis, eye.distance, towards), from))};
  }
  /// Depth [m] of a point at this distance along a line of sight.
  double depth(ViewRay const& line, double along) const {
    if (!eye.near()) return along;
    return dot(eye.seen(plus(line.from, along, line.towards)), towards);
  }
  std::array<double, 2> operator()(std::array<double, 3> const& p) const {
    return {x_shift + scale * dot(p, right), y_shift - scale * dot(p, up)};
  }
  /// The point of a pixel whose depth is 0 [m].
  std::array<double, 3> point(double x, double y) const {
    std::array<double, 3> p{};
    double const a = (x - x_shift) / scale, b = (y_shift - y) / scale;
    for (std::size_t c = 0; c < 3; ++c) p[c] = a * right[c] + b * up[c];
    return p;
  }
};

}  // namespace piola
