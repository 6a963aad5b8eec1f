// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/solid.hpp"
#include <array>

namespace piola::geometry {

/// Triangles with shared corners, as a file gives them or after welding.
struct Surface {
  std::vector<Vec<3>> X;                   ///< places of the corners [m]
  std::vector<std::array<int, 3>> corner;  ///< per face, counter-clockwise as seen from outside
  std::vector<int> group;                  ///< per face
  std::vector<std::string> group_name;     ///< as in the file, may be empty

  int faces() const { return static_cast<int>(corner.size()); }
  /// Normal times twice the area.
  Vec<3> twice_area(int face) const;
  Vec<3> middle(int face) const;
  double edge_length(int face, int side) const;
  /// Whether the corners lie on a line but for round-off, so that the face has no direction of its own.
  bool is_flat(int face) const;
  int longest_side(int face) const;
};

/// Adjacency of faces at edges. A half-edge is 3 * face + side; side k goes from corner k to the next.
struct Links {
  std::vector<int> across;        ///< per half-edge, the one of the neighbour; -1 where there is not exactly one
  std::vector<int> open;          ///< half-edges of edges used once
  std::vector<int> non_manifold;  ///< the first half-edge of each edge used more than twice
  std::vector<int> turned;        ///< the first half-edge of each edge between faces of opposite orientation
  std::vector<int> shell;         ///< per face, counted from 0 in the order of the faces
  int shells = 0;
};

/// Merges corners at the same place and drops faces with fewer than three corners and corners without faces. Returns
/// the number of dropped faces.
int weld(Surface& surface);

Links link_faces(Surface const& surface);

/// Turns faces so that neighbours agree, each shell encloses a positive volume, and shells inside an odd number of
/// other shells a negative one (cavities). Non-orientable surfaces stay unchanged in part. Returns the turned faces.
int orient(Surface& surface, Links const& links);

/// Enclosed volume [m3], by the divergence theorem.
double enclosed_volume(Surface const& surface);
double area_of(Surface const& surface);
Bounds bounds_of(Surface const& surface);

/// The largest extent of the box along an axis.
double largest_extent(Bounds const& box);

/// Per face the patch it belongs to, and the names of the patches: the groups of the file if it has more than one,
/// else connected faces whose normals turn by less than the angle [rad] from one to the next, "1", "2", and so on.
std::vector<int> patches_of(Surface const& surface, Links const& links, double feature_angle,
                            std::vector<Patch>& patches);

}  // namespace piola::geometry
