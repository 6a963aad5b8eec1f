// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/input/contact_capabilities.hpp"
#include "piola/model/region_checks.hpp"
#include "piola/particles/body_extents.hpp"
#include <algorithm>
#include <cmath>

/// Contact of bodies that go on behind mirror planes.
namespace piola {
namespace {

/// A plane across an axis, on whose side `inside` (1 or -1) the body is.
struct SymmetryPlace {
  std::size_t axis;
  double at;  ///< [m]
  double inside;
};

SymmetryPlace place_of_plane(MirrorSpec const& mirror, ParticleSet const& particles, Body const& body) {
  auto const axis = static_cast<std::size_t>(mirror.face.axis);
  bool const upper = mirror.face.upper;
  return {axis, extents_of(particles, body).at[axis][upper ? 1 : 0], upper ? -1.0 : 1.0};
}

/// How far the particles of a body stay off a plane, on its side, in spacings; negative: beyond it.
double clearance(CaseSpec const& spec, ParticleSet const& particles, std::size_t b, SymmetryPlace const& plane) {
  Body const& body = particles.bodies[b];
  double least = 1e300;
  for (auto id = body.first; id < body.last; ++id) {
    auto const x = start_of(spec.bodies[b], particles.X[static_cast<std::size_t>(id)]);
    least = std::min(least, plane.inside * (x[plane.axis] - plane.at));
  }
  return least / body.spacing[plane.axis];
}

bool has_plane(CaseSpec const& spec, ParticleSet const& particles, std::size_t b, SymmetryPlace const& plane) {
  return std::any_of(spec.mirrors.begin(), spec.mirrors.end(), [&](MirrorSpec const& mirror) {
    if (mirror.body != spec.bodies[b].name || mirror.antisymmetric) return false;
    SymmetryPlace const other = place_of_plane(mirror, particles, particles.bodies[b]);
    double const rounding = 1e-6 * particles.bodies[b].spacing[plane.axis];
    return other.axis == plane.axis && other.inside == plane.inside && std::fabs(other.at - plane.at) < rounding;
  });
}

}  // namespace

void check_mirrored_contact(CaseSpec const& spec, ParticleSet const& particles, Problems& problems) {
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  constexpr double free_of_the_plane = 0.5 * (1 + 1e-6);  // spacings: a body that touches the plane touches its image
  for (MirrorSpec const& mirror : spec.mirrors) {
    auto const named = std::find_if(spec.bodies.begin(), spec.bodies.end(),
                                    [&](BodySpec const& body) { return body.name == mirror.body; });
    if (named == spec.bodies.end()) continue;
    auto const a = static_cast<std::size_t>(named - spec.bodies.begin());
    SymmetryPlace const plane = place_of_plane(mirror, particles, particles.bodies[a]);
    for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
      if (b == a || !pushed_by_surface(spec, a, b) || has_plane(spec, particles, b, plane)) continue;
      double const off = clearance(spec, particles, b, plane);
      if (off > free_of_the_plane) continue;
      problems.add(
          place_of(mirror.places, "face"),
          "the mirror plane of body " + in_quotes(mirror.body) + ", " + "xyz"[plane.axis] + " = " +
              quantity_text(plane.at, "m") + ", " + (off < 0 ? "cuts through" : "touches") + " body " +
              in_quotes(spec.bodies[b].name) +
              ", which is no mirror there (allowed: bodies in contact have the same mirror planes, or stay off "
              "them) - give both the mirror, or neither");
    }
  }
}

}  // namespace piola
