// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/projection.hpp"
#include "piola/output/reference_mesh.hpp"
#include <vector>

namespace piola {

using Polyline = std::vector<Place3>;

/// The edges of a body's reference shape [m]: in 3D where outer facets meet at more than 40 degrees, in 2D the whole
/// boundary; joined to lines as long as they go, so that dashes run on. A body without cells has none.
std::vector<Polyline> feature_lines(ReferenceMesh const& mesh);

/// Draws dashed lines as coverage per sample, 0 or 1: `width` and `dash` in pixels; `fine`: samples per pixel.
struct DashedLines {
  Projection const& project;
  int fine = 2;
  double width = 1.2, dash = 6, gap = 4;
  void draw(std::vector<Polyline> const& lines, int columns, int rows, std::vector<float>& coverage) const;
};

}  // namespace piola
