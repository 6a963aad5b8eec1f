// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/boundary_keys.hpp"
#include "piola/input/sections.hpp"
#include <array>

namespace piola {
namespace {

void read_plane(Section const& section, int dimension, RigidSpec& shape) {
  read_components(section, "point", dimension, shape.centre);
  read_direction(section, "normal", dimension, shape.axis);
}

void read_sphere(Section const& section, int dimension, RigidSpec& shape) {
  read_components(section, "centre", dimension, shape.centre);
  read_members(section, rigid_keys(), shape);
}

void read_cylinder(Section const& section, int dimension, RigidSpec& shape) {
  if (dimension != 3) {
    section.problems().add(section.place(), "rigid.cylinder is given in " + std::to_string(dimension) +
                                                "D (allowed: 3D) - a cylinder in 2D is a sphere or a box");
    return;
  }
  read_sphere(section, dimension, shape);
  read_direction(section, "axis", dimension, shape.axis);
  double length = 0;
  if (section.read("length", length)) shape.half_lengths[0] = length / 2;
}

void read_corners(Section const& section, int dimension, RigidSpec& shape) {
  std::array<double, 3> min{}, max{};
  bool const low = read_components(section, "min", dimension, min);
  bool const high = read_components(section, "max", dimension, max);
  if (!low || !high) return;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) {
    shape.centre[d] = (min[d] + max[d]) / 2;
    shape.half_lengths[d] = (max[d] - min[d]) / 2;
    if (shape.half_lengths[d] > 0) continue;
    section.problems().add(section.place_of("max"), "rigid.box.max[" + std::to_string(d) + "] is " +
                                                        number_text(max[d]) + " m (allowed: above min, which is " +
                                                        number_text(min[d]) + " m)");
  }
}

void read_edges(Section const& section, int dimension, RigidSpec& shape) {
  read_components(section, "centre", dimension, shape.centre);
  std::array<double, 3> lengths{};
  if (!read_components(section, "lengths", dimension, lengths)) return;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) shape.half_lengths[d] = lengths[d] / 2;
}

// A box is given by its corners, or by its middle and its edges.
void read_box(Section const& section, int dimension, RigidSpec& shape) {
  bool const corners = section.has("min") && section.has("max");
  bool const edges = section.has("centre") && section.has("lengths");
  auto const given = section.has("min") + section.has("max") + section.has("centre") + section.has("lengths");
  if (given != 2 || corners == edges) {
    section.problems().add(section.place(),
                           "rigid.box needs min and max, or centre and lengths (allowed: one of the two pairs) - write "
                           "box = { min = [...], max = [...] }");
  } else if (corners) {
    read_corners(section, dimension, shape);
  } else {
    read_edges(section, dimension, shape);
  }
}

/// A box that reaches the axis is one on both sides of it.
void continue_behind_axis(RigidSpec& box) {
  double const low = box.centre[0] - box.half_lengths[0], high = box.centre[0] + box.half_lengths[0];
  if (low > 1e-9 * high) return;
  box.centre[0] = 0;
  box.half_lengths[0] = high;
}

void read_kind(Section const& section, int dimension, RigidSpec& shape) {
  constexpr std::array<std::string_view, 4> kinds{"plane", "sphere", "cylinder", "box"};
  constexpr std::array readers{&read_plane, &read_sphere, &read_cylinder, &read_box};
  int given = 0;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (!section.has(kinds[k])) continue;
    ++given;
    shape.kind = static_cast<RigidShape::Kind>(k);
    auto const part = section.table(kinds[k]);
    if (!part) continue;
    readers[k](*part, dimension, shape);
    part->refuse_unknown();
  }
  if (given == 1) return;
  section.refuse_count("rigid", given, "plane, sphere, cylinder, box");
}

}  // namespace

RigidSpec read_rigid(Section const& section, BodyNames const& names) {
  RigidSpec rigid;
  read_members(section, rigid_keys(), rigid);
  read_kind(section, names.dimension, rigid);
  if (names.axisymmetric && rigid.kind == RigidShape::Kind::box) continue_behind_axis(rigid);
  read_rigid_motion(section, names, rigid);
  section.refuse_unknown();
  rigid.places = places_of(section, {"name", "plane", "sphere", "cylinder", "box", "motion", "velocity",
                                     "angular_velocity", "gravity", "force", "torque", "mass"});
  return rigid;
}

}  // namespace piola
