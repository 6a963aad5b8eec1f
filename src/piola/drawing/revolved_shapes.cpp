// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/revolved_shapes.hpp"
#include "piola/base/contracts.hpp"
#include "piola/drawing/revolution.hpp"
#include "piola/drawing/revolved_skin.hpp"
#include "piola/drawing/vector_math.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace piola {
namespace {

using Kind = RigidShape::Kind;

std::vector<Point3> rectangle(double left, double right, double low, double high) {
  left = std::max(left, 0.0);
  return {{left, low, 0}, {right, low, 0}, {right, high, 0}, {left, high, 0}};
}

/// A disc, or half of one on the axis.
std::vector<Point3> round_section(Point3 const& centre, double radius) {
  constexpr int sides = 96;
  bool const half = centre[0] < radius;
  std::vector<Point3> corners;
  for (int k = 0; k < sides + (half ? 1 : 0); ++k) {
    double const a = std::numbers::pi * ((half ? 1.0 : 2.0) * k / sides - 0.5);
    corners.push_back({std::max(centre[0] + radius * std::cos(a), 0.0), centre[1] + radius * std::sin(a), 0});
  }
  return corners;
}

/// The corners of a convex section of a shape, in order.
std::vector<Point3> section_of(RigidShape const& shape, Stage const& stage) {
  if (shape.kind == Kind::sphere) return round_section(shape.centre, shape.radius);
  if (shape.kind == Kind::plane) {
    double const thick = 0.02 * stage.size(), face = shape.centre[1], back = face - thick * shape.axis[1];
    return rectangle(0, 0.7 * stage.size(), std::min(face, back), std::max(face, back));
  }
  Point3 const &middle = shape.centre, &half = shape.half_lengths;
  return rectangle(middle[0] - half[0], middle[0] + half[0], middle[1] - half[1], middle[1] + half[1]);
}

}  // namespace

Stage revolved(Stage const& section, double degrees) {
  Stage all = section;
  double const radius = std::max(std::abs(section.low[0]), std::abs(section.high[0]));
  for (std::size_t c : {0, 2}) {
    if (c == 2 && degrees == 0) continue;
    all.low[c] = -radius;
    all.high[c] = radius;
  }
  return all;
}

std::vector<RigidShape> with_mirror_images(std::span<RigidShape const> shapes) {
  std::vector<RigidShape> all(shapes.begin(), shapes.end());
  for (RigidShape const& shape : shapes) {
    if (shape.kind == Kind::plane || shape.centre[0] == 0) continue;
    all.push_back(shape);
    all.back().centre[0] *= -1;
  }
  return all;
}

Skin revolved(RigidShape const& shape, Stage const& stage, double degrees) {
  PIOLA_EXPECTS(degrees > 0);
  Skin half;
  half.place = half.reference = section_of(shape, stage);
  for (Index k = 1; k + 1 < static_cast<Index>(half.place.size()); ++k) half.facets.push_back({{0, k, k + 1}});
  return revolved(half, degrees, 1e-9 * stage.size());
}

void show_all_shapes(Window& window, View const& view, std::span<RigidShape const> shapes, Stage const& stage,
                     std::optional<double> const& swept) {
  if (!swept) return show_shapes(window, view, shapes, stage);
  if (*swept == 0) return show_shapes(window, view, with_mirror_images(shapes), stage);
  for (RigidShape const& shape : shapes) {
    if (shape.kind == Kind::plane) continue;
    Skin const skin = revolved(shape, stage, *swept);
    double const reach = std::accumulate(skin.place.begin(), skin.place.end(), 0.0, [&](double most, Point3 const& p) {
      return std::max(most, distance(p, stage.middle()));
    });
    if (reach <= 2 * stage.size()) window.include(view, skin.place, 0);
  }
}

}  // namespace piola
