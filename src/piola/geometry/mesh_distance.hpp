// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/mesh_surface.hpp"
#include <memory>
#include <optional>

/// The only file that uses Embree.
namespace piola::geometry {

/// Signed distances to a welded surface. Embree searches in single precision, in a box of size one around the mesh,
/// with an enlarged search radius. Every candidate face is measured in double precision; of equally near faces the
/// first counts. So the result does not depend on the search tree, the thread or the number of threads. The sign comes
/// from angle-weighted normals of face, edge or corner (Baerentzen and Aanaes, IEEE Trans. Vis. Comput. Graph. 11,
/// 2005), which is right for closed surfaces, or from rays for others.
class MeshDistance {
 public:
  enum class Sign { normals, rays };
  struct Hit {
    double distance;
    int face;
  };

  MeshDistance(Surface const& surface, Links const& links, Sign sign);
  ~MeshDistance();
  MeshDistance(MeshDistance const&) = delete;
  MeshDistance& operator=(MeshDistance const&) = delete;

  Foot at(Vec<3> const& X) const;
  /// Majority of seven rays: inside if they cross the surface an odd number of times. Single precision.
  bool inside_by_rays(Vec<3> const& X) const;
  /// First intersection of a ray beyond `start` [m]. Single precision.
  std::optional<Hit> ahead(Vec<3> const& X, Vec<3> const& direction, double start) const;

 private:
  struct Search;
  std::unique_ptr<Search> search_;
};

}  // namespace piola::geometry
