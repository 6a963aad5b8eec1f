// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/math/array_conversion.hpp"
#include "piola/mechanics/contact/rigid_surface.hpp"
#include "piola/model/region_checks.hpp"
#include <array>
#include <cmath>

namespace piola {
namespace {

using Vec3 = std::array<double, 3>;

// Place of the shape in the file.
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

void check_formulas(RigidSpec const& rigid, std::string const& key, std::array<Expression, 3> const& formulas,
                    Problems& problems) {
  for (std::size_t d = 0; d < formulas.size(); ++d) {
    double const value = formulas[d]({});
    if (std::isfinite(value)) continue;
    problems.add(place_of(rigid.places, key), "rigid." + key + "[" + std::to_string(d) + "], formula " +
                                                  in_quotes(formulas[d].text()) + " is " + number_text(value) +
                                                  " at t = 0 (allowed: a finite number)");
  }
}

}  // namespace

Vec3 start_of(BodySpec const& body, Vec3 const& X) {
  Vec3 x = X;
  for (std::size_t d = 0; body.initial_displacement && d < 3; ++d) x[d] += (*body.initial_displacement)[d](X);
  return x;
}

double distance_to(RigidShape const& shape, Vec3 const& x, int dimension) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  return contact::distance_from(contact::surface_of(shape, dimension), vector_of(x)).value;
}

void check_rigid(CaseSpec const& spec, ParticleSet const& particles, Problems& problems) {
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  for (RigidSpec const& rigid : spec.rigids) {
    check_formulas(rigid, "velocity", rigid.velocity, problems);
    check_formulas(rigid, "angular_velocity", rigid.angular_velocity, problems);
    check_formulas(rigid, "gravity", rigid.gravity, problems);
    check_formulas(rigid, "force", rigid.force, problems);
    check_formulas(rigid, "torque", rigid.torque, problems);
    for (std::size_t b = 0; b < spec.bodies.size(); ++b)
      check_overlap(rigid, spec.bodies[b], particles, particles.bodies[b], problems);
  }
}

}  // namespace piola
