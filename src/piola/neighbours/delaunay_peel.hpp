// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/neighbours/cells.hpp"

namespace piola {

/// Whether the volume of a simplex allows that its height is below 1e-3 of its longest edge.
bool nearly_flat(Cells const& cells, Index cell, Points const& points);

/// Takes nearly flat simplices off the surface, one after the other. Those with a circumradius above `largest_radius`
/// go as soon as a facet of them is on the surface; others if only the surface between the same points changes: a point
/// comes to it that lay just below, or (3D) the diagonal between four points is the other one. Inside they stay,
/// whatever their radius: without them the surface would have holes.
void peel_slivers(Cells& cells, Points const& points, double largest_radius);

}  // namespace piola
