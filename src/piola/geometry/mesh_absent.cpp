// SPDX-License-Identifier: Apache-2.0
// Stands for all other mesh files in builds with PIOLA_MESH=OFF.
#include "piola/geometry/mesh.hpp"

namespace piola::geometry {

SolidPtr read_mesh(std::string const& path, MeshOptions const& options, MeshReport& report) {
  return mesh_from_bytes({}, path.substr(path.rfind('/') + 1), options, report);
}

SolidPtr mesh_from_bytes(std::string_view, std::string const& name, MeshOptions const&, MeshReport& report) {
  report.problems.push_back(name + ": this program was built without meshes - build it with -DPIOLA_MESH=ON");
  return nullptr;
}

}  // namespace piola::geometry
