// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/projection.hpp"
#include "piola/drawing/reference_mesh.hpp"
#include <vector>

/// Outlines of axisymmetric bodies, see revolution.hpp.
namespace piola {

/// Returns the edges of the reference shape of a section with its mirror image (angle 0) or of the swept shape, and
/// what is round in it as the viewer of a projection sees it [m].
std::vector<Polyline> revolved_outline(ReferenceMesh const& mesh, double degrees, Projection const& project);

}  // namespace piola
