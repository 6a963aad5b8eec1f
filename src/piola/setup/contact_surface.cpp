// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/contact_surface.hpp"
#include "piola/base/contracts.hpp"
#include "piola/math/array_conversion.hpp"
#include "piola/particles/body_range.hpp"
#include "piola/setup/faces.hpp"
#include "piola/setup/packed_bodies.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

using Kind = ShapeSpec::Kind;

std::vector<Face> faces_of(ShapeSpec const& shape) {
  std::vector<Face> faces;
  auto const across = [&](int axis) {
    faces.push_back({axis, false, Face::Part::flat});
    faces.push_back({axis, true, Face::Part::flat});
  };
  if (shape.kind == Kind::box) {
    for (int axis = 0; axis < shape.dimension; ++axis) across(axis);
    return faces;
  }
  faces.push_back({0, false, Face::Part::outer});
  if (shape.inner_radius > 0) faces.push_back({0, false, Face::Part::inner});
  if (shape.kind == Kind::cylinder) across(shape.axis);
  return faces;
}

/// Where the surface is, straight ahead of X along the normal [m].
double height_above(ShapeSpec const& shape, Face const& face, std::array<double, 3> const& X) {
  auto const axis = static_cast<std::size_t>(face.axis);
  if (face.part == Face::Part::flat) {
    bool const box = shape.kind == Kind::box;
    double const low = box ? shape.min[axis] : shape.centre[axis];
    double const high = box ? shape.max[axis] : shape.centre[axis] + shape.length;
    return face.upper ? high - X[axis] : X[axis] - low;
  }
  double square = 0;
  for (std::size_t c = 0; c < static_cast<std::size_t>(shape.dimension); ++c)
    if (shape.kind != Kind::cylinder || c != static_cast<std::size_t>(shape.axis))
      square += (X[c] - shape.centre[c]) * (X[c] - shape.centre[c]);
  double const r = std::sqrt(square);
  return face.part == Face::Part::outer ? shape.radius - r : r - shape.inner_radius;
}

/// Distance by which a place on the tangent plane with this normal lies outside a curved face [m]; 0 next to another
/// face.
double rise_above(geometry::Solid const& solid, Vec<3> const& y, Vec<3> const& normal, double spacing) {
  constexpr double rounding = 1e-9, widest = 0.25;  // of the spacing
  constexpr double same_face = 0.9;                 // cosine
  geometry::Foot const foot = solid.at(y);
  double const size = std::fabs(foot.distance);
  bool const curved = size > rounding * spacing && size < widest * spacing && dot(foot.normal, normal) > same_face;
  return curved ? foot.distance : 0;
}

/// Adds a point for each patch of which a particle has a part. The centre of a part of a curved face lies off the face
/// by a third of its sagitta, which is corrected.
void add_patch_points(ShapeSpec const& shape, ParticleSet const& particles, Body const& body,
                      contact::Surface& surface) {
  constexpr double rounding = 1e-6;
  for (PatchWeight const& share : patch_weights(shape, particles, body)) {
    Vec<3> const area{{share.vector[0], share.vector[1], share.vector[2]}};
    double const size = std::sqrt(dot(area, area));
    if (!(size > rounding * share.area)) continue;  // a fold within one particle's reach
    Vec<3> const normal = (1 / size) * area;
    Vec<3> const X = vector_of(particles.X[static_cast<std::size_t>(share.particle)]);
    double height = dot(normal, vector_of(share.middle) - X);
    height -= rise_above(*shape.solid, X + height * normal, normal, surface.spacing);
    surface.points.push_back({share.particle, height * normal, normal, share.area});
  }
}

}  // namespace

contact::Surface contact_surface(ShapeSpec const& shape, ParticleSet const& particles, Body const& body) {
  PIOLA_EXPECTS(shape.dimension == particles.dimension && is_range_in(body, particles));
  PIOLA_EXPECTS(shape.kind != Kind::solid || shape.solid != nullptr);
  contact::Surface surface;
  surface.spacing = *std::max_element(body.spacing.begin(), body.spacing.begin() + particles.dimension);
  if (shape.kind == Kind::solid) {
    add_patch_points(shape, particles, body, surface);
    return surface;
  }
  surface.is_box = shape.kind == Kind::box;
  for (Face const& face : faces_of(shape))
    for (FaceWeight const& share : face_weights(shape, particles, body, face)) {
      Vec<3> const normal{{share.normal[0], share.normal[1], share.normal[2]}};
      double const height = height_above(shape, face, particles.X[static_cast<std::size_t>(share.particle)]);
      surface.points.push_back({share.particle, height * normal, normal, share.area});
    }
  return surface;
}

}  // namespace piola
