// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/primitives.hpp"
#include "piola/base/contracts.hpp"
#include "piola/geometry/extruded_revolved.hpp"
#include "piola/geometry/transformed_solid.hpp"
#include <cmath>
#include <numbers>

namespace piola::geometry {
namespace {

constexpr double pi = std::numbers::pi;
using Names = std::vector<std::string>;
using Loop = std::vector<ProfileEdge>;

/// Straight lines through corners, one patch each.
Loop polygon(std::vector<Vec<2>> const& corners, std::vector<int> const& patches) {
  Loop loop;
  for (std::size_t i = 0; i < corners.size(); ++i)
    loop.push_back(straight(corners[i], corners[(i + 1) % corners.size()], patches[i]));
  return loop;
}

SolidPtr along(SolidPtr solid, Vec<3> const& base, Vec<3> const& axis) {
  return placed(std::move(solid), {1, rotation_from_z(axis), base});
}

SolidPtr moved(SolidPtr solid, Vec<3> const& by) { return placed(std::move(solid), {1, identity<3>(), by}); }

}  // namespace

SolidPtr box(Vec<3> const& min, Vec<3> const& max, int dimension) {
  PIOLA_EXPECTS(dimension == 2 || dimension == 3);
  PIOLA_EXPECTS(min[0] < max[0] && min[1] < max[1] && (dimension == 2 || min[2] < max[2]));
  Profile rectangle(
      {polygon({{{min[0], min[1]}}, {{max[0], min[1]}}, {{max[0], max[1]}}, {{min[0], max[1]}}}, {2, 1, 3, 0})},
      {"-x", "+x", "-y", "+y"});
  if (dimension == 2) return std::make_shared<Flat>(std::move(rectangle));
  return std::make_shared<Extruded>(std::move(rectangle), min[2], max[2]);
}

SolidPtr ball(Vec<3> const& centre, double radius, double inner_radius, int dimension) {
  PIOLA_EXPECTS(dimension == 2 || dimension == 3);
  PIOLA_EXPECTS(inner_radius >= 0 && inner_radius < radius);
  bool const hollow = inner_radius > 0;
  Names const names = hollow ? Names{"outer", "inner"} : Names{"outer"};
  if (dimension == 2) {
    std::vector<Loop> loops{{arc({}, radius, 0, 2 * pi, 0)}};
    if (hollow) loops.push_back({arc({}, inner_radius, 0, -2 * pi, 1)});
    return moved(std::make_shared<Flat>(Profile(loops, names)), centre);
  }
  // Sets the ends of arcs exactly on the axis.
  auto const pole = [](ProfileEdge edge) {
    edge.from[0] = edge.to[0] = 0;
    return edge;
  };
  double const r = hollow ? inner_radius : 0;
  Loop loop{pole(arc({}, radius, -pi / 2, pi, 0)), straight({{0, radius}}, {{0, hollow ? r : -radius}}, 0)};
  if (hollow) {
    loop.push_back(pole(arc({}, r, pi / 2, -pi, 1)));
    loop.push_back(straight({{0, -r}}, {{0, -radius}}, 0));
  }
  return moved(std::make_shared<Revolved>(Profile::half(loop, names)), centre);
}

SolidPtr cylinder(Vec<3> const& base, Vec<3> const& axis, double length, double radius, double inner_radius) {
  PIOLA_EXPECTS(length > 0);
  PIOLA_EXPECTS(inner_radius >= 0 && inner_radius < radius);
  double const r = inner_radius;
  Names names{"outer", "start", "end"};
  if (r > 0) names.emplace_back("inner");
  Loop const loop = polygon({{{r, 0}}, {{radius, 0}}, {{radius, length}}, {{r, length}}}, {1, 0, 2, r > 0 ? 3 : 0});
  return along(std::make_shared<Revolved>(Profile::half(loop, names)), base, axis);
}

SolidPtr cone(Vec<3> const& base, Vec<3> const& axis, double length, double radius, double end_radius) {
  std::vector<Vec<2>> corners{{{0, 0}}};
  std::vector<int> patches;
  if (radius > 0) {
    corners.push_back({{radius, 0}});
    patches.push_back(1);
  }
  if (end_radius > 0) {
    corners.push_back({{end_radius, length}});
    patches.push_back(0);
  }
  corners.push_back({{0, length}});
  patches.push_back(end_radius > 0 ? 2 : 0);
  patches.push_back(0);
  return along(std::make_shared<Revolved>(Profile::half(polygon(corners, patches), {"outer", "start", "end"})), base,
               axis);
}

SolidPtr torus(Vec<3> const& centre, Vec<3> const& axis, double radius, double tube_radius) {
  Loop const loop{arc({{radius, 0}}, tube_radius, 0, 2 * pi, 0)};
  return along(std::make_shared<Revolved>(Profile::half(loop, {"outer"})), centre, axis);
}

SolidPtr capsule(Vec<3> const& from, Vec<3> const& to, double radius, int dimension) {
  PIOLA_EXPECTS(dimension == 2 || dimension == 3);
  Vec<3> const line = to - from;
  double const length = std::sqrt(dot(line, line));
  if (dimension == 2) {
    Loop const loop{arc({}, radius, pi / 2, pi, 0), straight({{0, -radius}}, {{length, -radius}}, 0),
                    arc({{length, 0}}, radius, -pi / 2, pi, 0), straight({{length, radius}}, {{0, radius}}, 0)};
    Mat<3> const turn = rotation_about({{0, 0, 1}}, std::atan2(line[1], line[0]));
    return placed(std::make_shared<Flat>(Profile({loop}, {"outer"})), {1, turn, from});
  }
  ProfileEdge low = arc({}, radius, -pi / 2, pi / 2, 0), high = arc({{0, length}}, radius, 0, pi / 2, 0);
  low.from[0] = high.to[0] = 0;
  Loop const loop{low, straight({{radius, 0}}, {{radius, length}}, 0), high,
                  straight({{0, length + radius}}, {{0, -radius}}, 0)};
  return along(std::make_shared<Revolved>(Profile::half(loop, {"outer"})), from, (1 / length) * line);
}

SolidPtr half_space(Vec<3> const& point, Vec<3> const& normal, int dimension) {
  PIOLA_EXPECTS(dimension == 2 || dimension == 3);
  return std::make_shared<HalfSpace>(point, normal, dimension);
}

}  // namespace piola::geometry
