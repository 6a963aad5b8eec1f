// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/section.hpp"
#include "piola/setup/shapes.hpp"

namespace piola {

/// Whether a shape is a solid: anything but a box, sphere or cylinder as it is, on a lattice or in rings.
bool is_solid_section(Section const& section);

/// Reads such a shape. `names`: constants for formulas.
ShapeSpec read_solid_shape(Section const& section, Names const& names);

/// Reads the solid alone of a shape, or a part of one, that has no particles of its own; null (and a problem) if
/// something is wrong. Files that are read are added to those of `shape`.
geometry::SolidPtr read_part_solid(Section const& section, Names const& names, ShapeSpec& shape);

/// Names and digests of what is in files, for the key of a packing.
std::string key_of(std::vector<CaseFile> const& files);

/// Reads the shape `points`, a file of particles.
ShapeSpec read_points_shape(Section const& section);
/// The key `unit`: how many m one of them has.
std::optional<double> read_length_unit(Section const& section);

/// The solid of a box, sphere or cylinder.
geometry::SolidPtr solid_of(ShapeSpec const& shape);

/// One of box, sphere, cylinder, torus, cone, capsule, half_space, formula, extrude, revolve; null if something is
/// wrong, which is then among the problems. `spacing` [m] is the scale of a formula's differences.
geometry::SolidPtr read_primitive(Section const& section, std::string_view kind, Names const& names, double spacing);

/// Up to three numbers as a vector; zero for those that are missing.
Vec<3> first_three(std::vector<double> const& numbers);

/// Reports the radius `value` of a hole or a tube unless it is below `radius`; 0: not given.
void check_below_radius(Section const& section, std::string_view key, double value, double radius);

/// Parts that shapes of both kinds read, internal to input/.
void read_box(Section const& section, ShapeSpec& shape);
void read_sphere(Section const& section, ShapeSpec& shape);
void read_cylinder(Section const& section, ShapeSpec& shape);

}  // namespace piola
