// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/rigid_surface.hpp"
#include "piola/base/contracts.hpp"
#include "piola/math/array_conversion.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola::contact {
namespace {

double length_of(Vec<3> const& a) { return std::sqrt(dot(a, a)); }

/// a over its length; a zero vector becomes `otherwise`.
Vec<3> unit(Vec<3> const& a, Vec<3> const& otherwise) {
  double const length = length_of(a);
  return length > 0 ? (1 / length) * a : otherwise;
}

/// Distances q[k] from the faces across the unit directions d[k], positive outside; the nearest point of the corner
/// they make is straight ahead where they are positive.
Distance from_faces(double const* q, Vec<3> const* d, int count) {
  int const nearest = static_cast<int>(std::max_element(q, q + count) - q);
  if (!(q[nearest] > 0)) return {q[nearest], d[nearest]};
  Vec<3> sum;
  for (int k = 0; k < count; ++k) sum = sum + std::max(q[k], 0.0) * d[k];
  return {length_of(sum), unit(sum, d[nearest])};
}

int side_of(double along, int side) { return side != 0 ? side : along < 0 ? -1 : 1; }

Distance from_cylinder(RigidSurface const& shape, Vec<3> const& r, Sides const& sides) {
  double const along = dot(r, shape.axis);
  Vec<3> const across = r - along * shape.axis;
  Vec<3> const other = std::fabs(shape.axis[0]) < 0.9 ? Vec<3>{{1, 0, 0}} : Vec<3>{{0, 1, 0}};
  Vec<3> const d[2] = {unit(across, unit(other - dot(other, shape.axis) * shape.axis, other)),
                       side_of(along, sides[0]) * shape.axis};
  double const q[2] = {length_of(across) - shape.radius, side_of(along, sides[0]) * along - shape.half_lengths[0]};
  return from_faces(q, d, 2);
}

Distance from_box(RigidSurface const& shape, Vec<3> const& r, Sides const& sides) {
  double q[3];
  Vec<3> d[3];
  Vec<3> const along = transpose(shape.turn) * r;
  for (int c = 0; c < shape.dimension; ++c) {
    double const side = side_of(along[c], sides[static_cast<std::size_t>(c)]);
    q[c] = side * along[c] - shape.half_lengths[c];
    d[c] = {{side * shape.turn(0, c), side * shape.turn(1, c), side * shape.turn(2, c)}};
  }
  return from_faces(q, d, shape.dimension);
}

/// Coordinates along the edges of a box, or along the axis of a cylinder and from it.
Vec<3> in_axes(RigidSurface const& shape, Vec<3> const& x) {
  Vec<3> const r = x - shape.centre;
  if (shape.kind != RigidSurface::Kind::cylinder) return transpose(shape.turn) * r;
  double const along = dot(r, shape.axis);
  return {{along, length_of(r - along * shape.axis), 0}};
}

/// The half extents along those coordinates; infinite where there is none.
Vec<3> extents(RigidSurface const& shape) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (shape.kind == RigidSurface::Kind::cylinder) return {{shape.half_lengths[0], shape.radius, none}};
  Vec<3> half = shape.half_lengths;
  for (int c = shape.dimension; c < 3; ++c) half[c] = none;
  return half;
}

Sides one_side(int axis, int side) {
  Sides sides{};
  sides[static_cast<std::size_t>(axis)] = side;
  return sides;
}

/// Whether the way from one place to another crosses the face of a side along axis c.
bool crosses(Vec<3> const& from, Vec<3> const& to, int c, int side, Vec<3> const& half) {
  double const start = side * from[c] - half[c], end = side * to[c] - half[c];
  if (!(start >= 0 && end < 0)) return false;
  Vec<3> const there = from + (start / (start - end)) * (to - from);
  for (int k = 0; k < 3; ++k)
    if (k != c && !(std::fabs(there[k]) <= half[k])) return false;
  return true;
}

}  // namespace

RigidSurface surface_of(RigidShape const& shape, int dimension) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  auto const &v = shape.velocity, &w = shape.angular_velocity;
  RigidSurface surface{shape.kind,
                       dimension,
                       vector_of(shape.centre),
                       vector_of(shape.axis),
                       vector_of(shape.half_lengths),
                       shape.radius,
                       {{v[0]({}, 0), v[1]({}, 0), v[2]({}, 0)}}};
  surface.angular_velocity = {{w[0]({}, 0), w[1]({}, 0), w[2]({}, 0)}};
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < 3; ++c)
      surface.turn(c, k) = shape.edges[static_cast<std::size_t>(k)][static_cast<std::size_t>(c)];
  return surface;
}

double RigidSurface::mobility(Vec<3> const& y, Vec<3> const& n) const {
  Vec<3> const arm = cross(y - centre, n);
  return inverse_mass + dot(arm, inverse_inertia * arm);
}

double RigidSurface::mobility(Vec<3> const& y) const {
  Vec<3> const r = y - centre;
  return inverse_mass + dot(r, r) * trace(inverse_inertia) - dot(r, inverse_inertia * r);
}

double reach_of(RigidSurface const& shape) {
  switch (shape.kind) {
    case RigidSurface::Kind::plane: return std::numeric_limits<double>::infinity();
    case RigidSurface::Kind::sphere: return shape.radius;
    default: return std::hypot(length_of(shape.half_lengths), shape.radius);
  }
}

double travel_from(RigidPose const& last, RigidSurface const& now) {
  double const way = length_of(now.centre - last.centre);
  Mat<3> const turned = now.turn - last.turn;
  double const size = std::sqrt(contract(turned, turned));
  return size > 0 ? way + size * reach_of(now) : way;
}

Distance distance_from(RigidSurface const& shape, Vec<3> const& x) { return distance_from(shape, x, {}); }

Distance distance_from(RigidSurface const& shape, Vec<3> const& x, Sides const& sides) {
  Vec<3> r = x - shape.centre;
  for (int c = shape.dimension; c < 3; ++c) r[c] = 0;
  switch (shape.kind) {
    case RigidSurface::Kind::plane: return {dot(r, shape.axis), shape.axis};
    case RigidSurface::Kind::sphere: return {length_of(r) - shape.radius, unit(r, {{1, 0, 0}})};
    case RigidSurface::Kind::cylinder: return from_cylinder(shape, r, sides);
    case RigidSurface::Kind::box: break;
  }
  return from_box(shape, r, sides);
}

Vec<3> normal_change(RigidSurface const& shape, Vec<3> const& x, Vec<3> const& normal, Vec<3> const& along) {
  Vec<3> r = x - shape.centre, tangent = along - dot(along, normal) * normal;
  for (int c = shape.dimension; c < 3; ++c) r[c] = tangent[c] = 0;
  constexpr double lateral = 0.5;  // cosine between the axis of a cylinder and the normals of its ends is 1
  if (shape.kind == RigidSurface::Kind::cylinder && std::fabs(dot(normal, shape.axis)) < lateral) {
    tangent = tangent - dot(tangent, shape.axis) * shape.axis;
    return (1 / dot(r, normal)) * tangent;
  }
  if (shape.kind == RigidSurface::Kind::sphere) return (1 / dot(r, normal)) * tangent;
  return {};
}

std::array<bool, 3> thin_along(RigidSurface const& shape, double length) {
  PIOLA_EXPECTS(length > 0);
  std::array<bool, 3> thin{};
  if (shape.kind == RigidSurface::Kind::box)
    for (int c = 0; c < shape.dimension; ++c) thin[static_cast<std::size_t>(c)] = 2 * shape.half_lengths[c] < length;
  if (shape.kind == RigidSurface::Kind::cylinder)
    thin[0] = 2 * shape.half_lengths[0] < length && !(2 * shape.radius < length);
  return thin;
}

double beyond(RigidSurface const& shape, Vec<3> const& x, Sides const& sides) {
  Vec<3> const at = in_axes(shape, x), half = extents(shape);
  for (int c = 0; c < 3; ++c)
    if (int const side = sides[static_cast<std::size_t>(c)]; side != 0) return -side * at[c] - half[c];
  return -std::numeric_limits<double>::infinity();
}

std::optional<Sides> entered(RigidSurface const& shape, Vec<3> const& x, RigidPose const& last, Vec<3> const& before,
                             std::array<bool, 3> const& thin) {
  RigidSurface then = shape;
  then.centre = last.centre;
  then.turn = last.turn;
  then.axis = last.turn * (transpose(shape.turn) * shape.axis);
  Vec<3> const from = in_axes(then, before), to = in_axes(shape, x), half = extents(shape);
  int nearest = 0;  // of the faces around a point that is inside: by rounding it may have been inside before
  bool inside = true;
  for (int c = 0; c < 3; ++c) {
    int const side = side_of(from[c], 0);
    if (thin[static_cast<std::size_t>(c)] && crosses(from, to, c, side, half)) return one_side(c, side);
    inside = inside && std::fabs(to[c]) < half[c];
    if (std::fabs(to[c]) - half[c] > std::fabs(to[nearest]) - half[nearest]) nearest = c;
  }
  if (!inside || !thin[static_cast<std::size_t>(nearest)]) return std::nullopt;
  return one_side(nearest, side_of(to[nearest], 0));
}

}  // namespace piola::contact
