// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/formulations/registry.hpp"
#include "piola/model/region_checks.hpp"
#include "piola/particles/body_extents.hpp"
#include <algorithm>
#include <cmath>
#include <string>

namespace piola {
namespace {

std::string const axisymmetric = "geometry is \"axisymmetric\", ";

/// Settings of formulations that assume something about the third direction.
void check_formulation(BodySpec const& body, Problems& problems) {
  auto const info = find_formulation(body.formulation.name);
  if (!info) return;
  Place const place = place_of(body.places, "formulation");
  if (!info->axisymmetric) problems.add(place, refusal(*info, "axisymmetric bodies"));
  auto const word = [&](std::string const& name) {
    auto const found = body.formulation.words.find(name);
    return found == body.formulation.words.end() ? std::string() : found->second;
  };
  std::string const assumption = word("assumption");
  if (!assumption.empty() && assumption != "as_dimension")
    problems.add(place, axisymmetric +
                            "where the third direction is that of the circle: formulation.assumption has no "
                            "meaning (allowed: its default) - leave it out");
  if (word("pressure") == "implicit")
    problems.add(place, axisymmetric + "and formulation.pressure is \"implicit\" (allowed: explicit) - leave it out");
  if (body.initial_deformation_gradient)
    problems.add(place_of(body.places, "initial_deformation_gradient"),
                 axisymmetric +
                     "and body.initial_deformation_gradient has no hoop stretch (allowed: "
                     "initial_displacement) - give initial_displacement instead");
}

void check_shape(BodySpec const& spec, ParticleSet const& particles, Body const& body, Problems& problems) {
  Place const place = place_of(spec.places, "shape");
  using enum ShapeSpec::Arrangement;
  if (spec.shape.arrangement == rings || spec.shape.arrangement == lattice_with_rings)
    problems.add(place, axisymmetric +
                            "and body.shape.arrangement is circles in the section (allowed: lattice, "
                            "packed) - change the arrangement");
  bool const disc = spec.shape.kind == ShapeSpec::Kind::sphere;
  double const centre = spec.shape.centre[0], radius = spec.shape.radius;
  if (disc && centre != 0 && centre < radius)
    problems.add(place, axisymmetric + "and the centre of the disc is " + quantity_text(centre, "m") +
                            " from the axis, less than its radius " + quantity_text(radius, "m") +
                            " (allowed: 0, a ball; the radius or more, a torus) - move the centre, or take "
                            "arrangement = \"packed\" for the part beyond the axis to be cut off");
  double low = 0;
  for (auto id = body.first; id < body.last; ++id) low = std::min(low, particles.X[static_cast<std::size_t>(id)][0]);
  if (low < 0)
    problems.add(place, axisymmetric + "where x is the radius, and body " + in_quotes(spec.name) + " reaches to x = " +
                            quantity_text(low, "m") + " (allowed: 0 or more) - give one half of the section");
}

/// A radial velocity on the axis.
void check_velocity(BodySpec const& spec, ParticleSet const& particles, Body const& body, Problems& problems) {
  if (!touches_axis(particles, body)) return;
  double const tolerance = 1e-6 * body.spacing[0];
  for (auto id = body.first; id < body.last; ++id) {
    auto const& X = particles.X[static_cast<std::size_t>(id)];
    if (X[0] > tolerance || !(std::abs(spec.initial_velocity[0](X)) > 0)) continue;
    problems.add(place_of(spec.places, "initial_velocity"),
                 axisymmetric + "and body.initial_velocity[0] of " + in_quotes(spec.name) + " is " +
                     quantity_text(spec.initial_velocity[0](X), "m/s") + " on the axis, at " +
                     point_text(X, particles.dimension) + " (allowed: 0 there) - multiply it by X");
    return;
  }
}

bool is_zero(Expression const& formula) { return formula.text() == "0" || formula.text().empty(); }

void check_loads(CaseSpec const& spec, Problems& problems) {
  for (LoadSpec const& load : spec.loads) {
    if (!load.on_face() && !is_zero(load.value[0]))
      problems.add(place_of(load.places, ""),
                   axisymmetric + "and the load of body " + in_quotes(load.body) +
                       " acts on the volume along the radius (allowed: 0; along y) - set the first component to 0");
    if (load.on_face() && load.face.part == Face::Part::flat && load.face.axis == 0 && !load.face.upper &&
        load.shape.kind == ShapeSpec::Kind::box && !(load.shape.min[0] > 0))
      problems.add(place_of(load.places, "face"),
                   axisymmetric + "and the face -x of body " + in_quotes(load.body) +
                       " is the axis, which has no area (allowed: +x, -y, +y) - take another face");
  }
}

void check_rigids(CaseSpec const& spec, Problems& problems) {
  for (RigidSpec const& rigid : spec.rigids) {
    Place const place = place_of(rigid.places, "");
    std::string const name = "rigid shape " + in_quotes(rigid.name);
    if (rigid.kind == RigidShape::Kind::plane && rigid.axis[0] != 0)
      problems.add(place, axisymmetric + "and " + name +
                              " is a plane that is not normal to the axis (allowed: normal [0, 1] or [0, -1]) - take a "
                              "plane across the axis");
    if (rigid.kind == RigidShape::Kind::box && rigid.edges[0][0] != 1)
      problems.add(place, axisymmetric + "and " + name +
                              " is turned in the section (allowed: edges along x and y) - "
                              "leave out its turn");
    if (!rigid.free && rigid.turns())
      problems.add(place, axisymmetric + "and " + name + " turns (allowed: no angular velocity) - leave it out");
    if (rigid.free && spec.rigids.size() > 1)
      problems.add(place, axisymmetric + "and " + name +
                              " is free beside another rigid shape (allowed: one rigid shape "
                              "if one is free) - take a body of particles for one of them");
    if (rigid.kind == RigidShape::Kind::sphere && rigid.centre[0] != 0 && rigid.centre[0] < rigid.radius)
      problems.add(place, axisymmetric + "and the centre of " + name +
                              " is nearer to the axis than its radius (allowed: "
                              "on the axis, or the radius or more from it) - "
                              "move it");
    if (!is_zero(rigid.velocity[0]))
      problems.add(place, axisymmetric + "and " + name +
                              " moves along the radius (allowed: along y) - set the first "
                              "component of its velocity to 0");
    if (!is_zero(rigid.force[0]))
      problems.add(place, axisymmetric + "and a force on " + name +
                              " acts along the radius (allowed: along y) - set its first component to 0");
  }
}

void check_probes(CaseSpec const& spec, Problems& problems) {
  for (ProbeSpec const& probe : spec.probes) {
    if (probe.kind == ProbeKind::twist)
      problems.add(place_of(probe.places, "kind"),
                   axisymmetric + "and probe " + in_quotes(probe.name) +
                       " looks around the axis (allowed: the other kinds) - take point, "
                       "average or extent");
    if (probe.kind == ProbeKind::hole && (probe.axis != 1 || probe.at[0] != 0))
      problems.add(place_of(probe.places, "axis"),
                   axisymmetric + "and probe " + in_quotes(probe.name) +
                       " looks for a hole along another line than the axis (allowed: axis = \"y\" and at = [0, ...]) - "
                       "set both");
  }
}

}  // namespace

bool is_in_sections(CaseSpec const& spec) {
  return spec.axisymmetric && std::all_of(spec.bodies.begin(), spec.bodies.end(),
                                          [](BodySpec const& body) { return body.shape.dimension == 2; });
}

void check_axisymmetry(CaseSpec const& spec, ParticleSet const& particles, Problems& problems) {
  if (!spec.axisymmetric) return;
  if (!is_in_sections(spec)) {
    problems.add(place_of(spec.bodies.front().places, "shape"),
                 axisymmetric +
                     "and bodies are not in 2D (allowed: shapes with two components, radius and height) - "
                     "give half sections");
    return;
  }
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    check_formulation(spec.bodies[b], problems);
    check_shape(spec.bodies[b], particles, particles.bodies[b], problems);
    check_velocity(spec.bodies[b], particles, particles.bodies[b], problems);
  }
  check_loads(spec, problems);
  check_rigids(spec, problems);
  for (MirrorSpec const& mirror : spec.mirrors)
    if (mirror.face.axis == 0)
      problems.add(place_of(mirror.places, "face"), axisymmetric +
                                                        "and a mirror is normal to the radius (allowed: "
                                                        "normal to y; the axis is one by itself) - remove "
                                                        "it");
  check_probes(spec, problems);
  for (CrackSpec const& crack : spec.cracks)
    problems.add(place_of(crack.places, ""), axisymmetric + "and there is a crack (allowed: none) - remove it");
}

}  // namespace piola
