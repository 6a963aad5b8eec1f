// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/mesh_surface.hpp"
#include <memory>
#include <optional>

/// The only place that knows Embree.
namespace piola::geometry {

/// Signed distances to a welded surface. Embree searches in single precision, in a box of size one around the mesh, and
/// is asked for more than is needed; every face it offers is measured in double precision, and of faces equally near
/// the first counts. So the answer does not depend on the search tree, the thread or the number of threads. The sign
/// comes from angle-weighted normals of face, edge or corner (Baerentzen and Aanaes, IEEE Trans. Vis. Comput. Graph.
/// 11, 2005), which is right for closed surfaces, or from rays for others.
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
  /// The opinion of most of seven rays: inside if they cross the surface an odd number of times. Single precision.
  bool inside_by_rays(Vec<3> const& X) const;
  /// What a ray meets first, beyond `start` [m]. Single precision.
  std::optional<Hit> ahead(Vec<3> const& X, Vec<3> const& direction, double start) const;

 private:
  struct Search;
  std::unique_ptr<Search> search_;
};

}  // namespace piola::geometry
