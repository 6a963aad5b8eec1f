// SPDX-License-Identifier: Apache-2.0
#include "contact_report.hpp"
#include "piola/base/text.hpp"
#include "piola/input/contact_capabilities.hpp"
#include "streams.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola::app {
namespace {

std::string shape_text(RigidShape const& shape, int dimension) {
  auto const point = [&](std::array<double, 3> const& x, char const* unit) {
    std::string text;
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
      text += (d > 0 ? ", " : "") + number_text(x[d], 4);
    return "(" + text + ")" + unit;
  };
  std::string const centre = point(shape.centre, " m"), radius = "radius " + quantity_text(shape.radius, "m");
  switch (shape.kind) {
    case RigidShape::Kind::plane: return "plane through " + centre + ", normal " + point(shape.axis, "");
    case RigidShape::Kind::sphere: return "sphere about " + centre + ", " + radius;
    case RigidShape::Kind::cylinder:
      return "cylinder about " + centre + ", axis " + point(shape.axis, "") + ", " + radius + ", length " +
             quantity_text(2 * shape.half_lengths[0], "m");
    case RigidShape::Kind::box: break;
  }
  std::array<double, 3> lengths = shape.half_lengths;
  for (double& length : lengths) length *= 2;
  return "box about " + centre + ", edges " + point(lengths, " m");
}

std::string friction_text(contact::FrictionLaw const& law) {
  if (!law.any()) return "without friction";
  std::string text = "friction " + number_text(law.kinetic);
  if (law.still > 0)
    text += fmt::format(" ({} at rest, over {})", number_text(law.still), quantity_text(law.decay_speed, "m/s"));
  if (std::isfinite(law.shear_limit)) text += ", at most " + quantity_text(law.shear_limit, "Pa");
  return text;
}

/// Prints the pairs of bodies in colour contact, without surfaces.
void print_colours(CaseSpec const& spec) {
  std::vector<std::string> pairs;
  auto const& bodies = spec.bodies;
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = a + 1; b < bodies.size(); ++b)
      if (pushed_by_colour(spec, a, b)) pairs.push_back(bodies[a].name + "-" + bodies[b].name);
  if (!pairs.empty()) print_result("contact by colour, without friction: {}\n", joined(pairs));
}

/// Prints the pairs in surface contact with their friction and stiffness scale.
void print_surfaces(CaseSpec const& spec) {
  if (!has_surface_contact(spec)) return;
  std::vector<std::string> pairs;
  auto const& bodies = spec.bodies;
  for (std::size_t a = 0; a < bodies.size(); ++a) {
    for (std::size_t b = a; b < bodies.size(); ++b)
      if (pushed_by_surface(spec, a, b)) pairs.push_back(bodies[a].name + "-" + bodies[b].name);
    for (std::size_t r = 0; r < spec.rigids.size(); ++r)
      if (pushed_by_rigid(spec, a, r)) pairs.push_back(bodies[a].name + "-" + spec.rigids[r].name);
  }
  constexpr std::size_t most = 8;
  std::size_t const left_out = pairs.size() > most ? pairs.size() - most : 0;
  pairs.resize(pairs.size() - left_out);
  ContactRule const rule = spec.contact ? ContactRule(*spec.contact) : ContactRule();
  print_result("contact of surfaces: {}{}, {}{}\n", joined(pairs),
               left_out > 0 ? " and " + count_text(static_cast<std::int64_t>(left_out)) + " more" : "",
               friction_text(rule.friction), rule.scale != 1 ? ", scale " + number_text(rule.scale) : "");
  for (ContactPairSpec const& pair : spec.contact_pairs)
    print_result("  {}-{}: {}{}\n", pair.between[0], pair.between[1],
                 pair.off ? "no contact" : friction_text(pair.friction),
                 !pair.off && pair.scale != 1 ? ", scale " + number_text(pair.scale) : "");
}

void print_springs(CaseSpec const& spec, int dimension) {
  bool const per_length = dimension == 2 && !spec.axisymmetric;
  for (SpringSpec const& spring : spec.springs)
    print_result(
        "spring \"{}\" of \"{}\" and {}: {}, damping {}, length without force {}\n", spring.name,
        spec.rigids[spring.first].name, spring.second ? in_quotes(spec.rigids[*spring.second].name) : "a point at rest",
        quantity_text(spring.stiffness, per_length ? "N/m^2" : "N/m"),
        quantity_text(spring.damping, per_length ? "N s/m^2" : "N s/m"), quantity_text(spring.rest_length, "m"));
}

/// The forces that act on a free rigid shape, after a comma.
std::string forces_text(RigidSpec const& rigid, int dimension) {
  std::string text;
  auto const add = [&](char const* what, std::array<Expression, 3> const& formulas, int count) {
    bool const any = std::any_of(formulas.begin(), formulas.end(), [](Expression const& e) { return e.text() != "0"; });
    if (any) text += std::string(", ") + what + " " + (count == 0 ? formulas[2].text() : vector_text(formulas, count));
  };
  add("gravity", rigid.gravity, dimension);
  add("force", rigid.force, dimension);
  add(rigid.torque_axes == RigidShape::TorqueAxes::body ? "torque in its axes" : "torque", rigid.torque,
      dimension == 3 ? 3 : 0);
  return text;
}

}  // namespace

std::string vector_text(std::array<Expression, 3> const& formulas, int dimension) {
  std::string text = "(";
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
    text += (d > 0 ? ", " : "") + formulas[d].text();
  return text + ")";
}

void print_contact(CaseSpec const& spec, int dimension) {
  for (RigidSpec const& rigid : spec.rigids) {
    bool const moves = std::any_of(rigid.velocity.begin(), rigid.velocity.end(),
                                   [](Expression const& component) { return component.text() != "0"; });
    std::string const speed = moves ? vector_text(rigid.velocity, dimension) + " m/s" : "";
    std::string motion = moves ? ", driven at " + speed : "";
    if (rigid.free)
      motion = ", free, mass " + quantity_text(rigid.mass, dimension == 2 && !spec.axisymmetric ? "kg/m" : "kg") +
               (moves ? ", starts at " + speed : "") + forces_text(rigid, dimension);
    else if (rigid.turns())
      motion += ", turning";
    print_result("rigid shape \"{}\": {}{}\n", rigid.name, shape_text(rigid, dimension), motion);
  }
  print_springs(spec, dimension);
  print_surfaces(spec);
  print_colours(spec);
  bool const own = has_kernel_contact(spec);
  if (!own) return;
  constexpr std::array<std::string_view, 5> laws{"none", "kernel", "linear", "published", "surface"};
  ContactRule const rule = spec.contact ? ContactRule(*spec.contact) : ContactRule();
  std::string text;
  if (rule.scale != 1) text += ", scale " + number_text(rule.scale);
  if (rule.law == ContactRule::Law::as_published)
    text += ", stiffness " + quantity_text(rule.stiffness, "Pa/m^" + std::to_string(dimension));
  if (std::isfinite(rule.closing_speed)) text += ", closing speed " + quantity_text(rule.closing_speed, "m/s");
  print_result("contact: law {}{}\n", laws[static_cast<std::size_t>(rule.law)], text);
}

}  // namespace piola::app
