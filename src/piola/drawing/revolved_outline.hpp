// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/reference_mesh.hpp"
#include <vector>

/// Outlines of axisymmetric bodies, see revolution.hpp.
namespace piola {

/// Returns the edges of the reference shape of a section with its mirror image (angle 0) or of the swept shape, and
/// what is round in it as a viewer in that direction sees it [m].
std::vector<Polyline> revolved_outline(ReferenceMesh const& mesh, double degrees, Point3 const& towards_viewer);

}  // namespace piola
