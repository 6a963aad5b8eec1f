// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/solid.hpp"

namespace piola::geometry {

/// The primitives of a case file. Lengths in m; a dimension of 2 gives regions of the plane. The caller must refuse
/// invalid input (a radius that is not positive, ...).

/// Patches "-x", "+x", "-y", ...
SolidPtr box(Vec<3> const& min, Vec<3> const& max, int dimension);
/// A ball or a disc, with a hole about its centre if the inner radius is above 0. Patches "outer", "inner".
SolidPtr ball(Vec<3> const& centre, double radius, double inner_radius, int dimension);
/// Patches "outer", "inner" and "start", "end" at and beyond `base`; `axis` is a unit vector.
SolidPtr cylinder(Vec<3> const& base, Vec<3> const& axis, double length, double radius, double inner_radius);
/// A cone from the radius at `base` to that at the end; one of them may be 0. Patches "outer", "start", "end".
SolidPtr cone(Vec<3> const& base, Vec<3> const& axis, double length, double radius, double end_radius);
/// Patch "outer".
SolidPtr torus(Vec<3> const& centre, Vec<3> const& axis, double radius, double tube_radius);
/// All places within the radius of a line. Patch "outer".
SolidPtr capsule(Vec<3> const& from, Vec<3> const& to, double radius, int dimension);
/// All places on the side of the point from which the unit normal points away. Patch "plane".
SolidPtr half_space(Vec<3> const& point, Vec<3> const& normal, int dimension);

}  // namespace piola::geometry
