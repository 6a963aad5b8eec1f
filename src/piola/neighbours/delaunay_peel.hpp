// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/neighbours/mesh_cells.hpp"

namespace piola {

/// Whether the volume of a simplex allows that its height is below 1e-3 of its longest edge.
bool nearly_flat(Cells const& cells, Index cell, Points const& points);

/// Removes nearly flat simplices from the surface, one after the other. A simplex with a circumradius above
/// `largest_radius` is removed as soon as one of its facets is on the surface. Any other one is removed only if the
/// surface keeps its points: it gains a point just below it, or (3D) the diagonal between four points flips. Interior
/// simplices stay whatever their radius, because their removal would leave holes.
void peel_slivers(Cells& cells, Points const& points, double largest_radius);

}  // namespace piola
