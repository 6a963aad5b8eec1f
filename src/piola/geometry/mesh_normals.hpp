// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/mesh_surface.hpp"

namespace piola::geometry {

/// The place of a triangle that is nearest to a point: on its face (feature 0), on side k (1 + k), at corner k (4 + k).
struct TriangleFoot {
  Vec<3> X;
  int feature = 0;
};
TriangleFoot foot_on_triangle(Vec<3> const& X, Vec<3> const& a, Vec<3> const& b, Vec<3> const& c);

/// Normals that determine the side of a closed surface for any nearest place: of faces, of edges (sum of the two faces)
/// and of corners (faces weighted by their angles). A degenerate face, which has no normal, takes that of the neighbour
/// across its longest side, and passes it on across its short sides.
class SurfaceNormals {
 public:
  SurfaceNormals(Surface const& surface, Links const& links);
  /// Unit vector; zero where normals cancel.
  Vec<3> at(int face, int feature) const;

 private:
  Vec<3> seen_over(Surface const& surface, Links const& links, int half) const;
  std::vector<Vec<3>> face_, side_, corner_;
  std::vector<std::array<int, 3>> corners_of_;
};

}  // namespace piola::geometry
