// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/projection.hpp"
#include "piola/drawing/reference_mesh.hpp"
#include <vector>

namespace piola {

/// Finds the edges of a body's reference shape: in 3D where outer facets meet at more than 55 degrees, in 2D the whole
/// boundary; joined to lines as long as they go, so that dashes run on [m]. A body without cells has none. Smooth edges
/// in 3D are stored in mesh.round.
void find_feature_lines(ReferenceMesh& mesh);

/// The outline of what is round [m], seen by a viewer in that direction.
std::vector<Polyline> silhouette(ReferenceMesh const& mesh, Point3 const& towards_viewer);

/// Draws dashed lines as coverage per sample, 0 or 1: `width` and `dash` in pixels; `fine`: samples per pixel.
struct DashedLines {
  Projection const& project;
  int fine = 2;
  double width = 1.2, dash = 6, gap = 4;
  void draw(std::vector<Polyline> const& lines, int columns, int rows, std::vector<float>& coverage) const;
};

}  // namespace piola
