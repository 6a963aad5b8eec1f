// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/region_checks.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace piola {
namespace {

using Vec3 = std::array<double, 3>;
using Kind = RigidShape::Kind;

double dot(Vec3 const& a, Vec3 const& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Where the shape itself stands in the file.
Place place_of_shape(RigidSpec const& rigid) {
  constexpr std::array<std::string_view, 4> keys{"plane", "sphere", "cylinder", "box"};
  return place_of(rigid.places, keys[static_cast<std::size_t>(rigid.kind)]);
}

void check_overlap(RigidSpec const& rigid, BodySpec const& spec, ParticleSet const& particles, Body const& body,
                   Problems& problems) {
  constexpr double rounding = 1e-9;  // of the spacing: particles on the surface are not inside
  double const allowed = rounding * body.spacing[0];
  std::int64_t inside = 0;
  Vec3 first{};
  for (std::int64_t id = body.first; id < body.last; ++id) {
    Vec3 const x = start_of(spec, particles.X[static_cast<std::size_t>(id)]);
    if (!(distance_to(rigid, x, particles.dimension) < -allowed)) continue;
    if (inside++ == 0) first = x;
  }
  if (inside == 0) return;
  problems.add(place_of_shape(rigid), "the rigid shape " + in_quotes(rigid.name) + " holds " + count_text(inside) +
                                          (inside == 1 ? " particle" : " particles") + " of body " +
                                          in_quotes(spec.name) + " at the start, the first at " +
                                          point_text(first, particles.dimension) +
                                          " (allowed: none) - move the shape or the body");
}

void check_velocity(RigidSpec const& rigid, int dimension, Problems& problems) {
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) {
    double const value = rigid.velocity[d]({});
    if (std::isfinite(value)) continue;
    problems.add(place_of(rigid.places, "velocity"), "rigid.velocity[" + std::to_string(d) + "], formula " +
                                                         in_quotes(rigid.velocity[d].text()) + " is " +
                                                         number_text(value) + " at t = 0 (allowed: a finite number)");
  }
}

/// How far a point lies outside each face of a shape whose sides are its axes [m]; negative: inside.
std::array<double, 3> outside_faces(RigidShape const& shape, Vec3 const& r, int dimension) {
  std::array<double, 3> q;
  q.fill(-std::numeric_limits<double>::infinity());
  if (shape.kind == Kind::cylinder) {
    double const along = dot(r, shape.axis);
    q[0] = std::abs(along) - shape.half_lengths[0];
    q[1] = std::sqrt(std::max(0.0, dot(r, r) - along * along)) - shape.radius;
    return q;
  }
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) q[d] = std::abs(r[d]) - shape.half_lengths[d];
  return q;
}

}  // namespace

Vec3 start_of(BodySpec const& body, Vec3 const& X) {
  Vec3 x = X;
  for (std::size_t d = 0; body.initial_displacement && d < 3; ++d) x[d] += (*body.initial_displacement)[d](X);
  return x;
}

double distance_to(RigidShape const& shape, Vec3 const& x, int dimension) {
  Vec3 const r{x[0] - shape.centre[0], x[1] - shape.centre[1], x[2] - shape.centre[2]};
  if (shape.kind == Kind::plane) return dot(r, shape.axis);
  if (shape.kind == Kind::sphere) return std::sqrt(dot(r, r)) - shape.radius;
  auto const q = outside_faces(shape, r, dimension);
  double const nearest = std::max({q[0], q[1], q[2]});
  return nearest < 0 ? nearest : std::hypot(std::max(q[0], 0.0), std::max(q[1], 0.0), std::max(q[2], 0.0));
}

void check_rigid(CaseSpec const& spec, ParticleSet const& particles, Problems& problems) {
  for (RigidSpec const& rigid : spec.rigids) {
    check_velocity(rigid, particles.dimension, problems);
    for (std::size_t b = 0; b < spec.bodies.size(); ++b)
      check_overlap(rigid, spec.bodies[b], particles, particles.bodies[b], problems);
  }
}

}  // namespace piola
