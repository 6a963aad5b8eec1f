// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/mesh_surface.hpp"

namespace piola::geometry {

/// Merges corners within `distance` [m] of each other at the first of them, and drops faces left with fewer than three
/// corners. Chains of near corners become one corner, too. Does nothing for distances below 1e-12 of the surface's
/// extent. The surface must be welded. Returns the number of merged corners.
int merge_corners(Surface& surface, double distance);

/// The distance [m] that merges the corners of all open edges so that the surface is closed; 0 if there is none below
/// a quarter of the mean length of these edges. Complexity: as of a welding.
double closing_distance(Surface const& surface, Links const& links);

/// Removed by remove_needless_faces.
struct RemovedFaces {
  int twice = 0;         ///< copies of a face, walls between parts that touch among them
  int without_area = 0;  ///< with corners on a line, at edges that have not two faces
};

/// Removes duplicate faces, i.e. faces with the same three corners. Keeps one of those with equal orientation. Keeps
/// none of equally many of either orientation, which enclose nothing, unless the whole surface is given twice, once
/// from each side. Then removes faces without area at open or non-manifold edges. The surface must be welded.
RemovedFaces remove_needless_faces(Surface& surface);

}  // namespace piola::geometry
