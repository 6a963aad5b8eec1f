// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/mesh.hpp"
#include "piola/geometry/mesh_surface.hpp"
#include <string_view>

/// The only place that knows assimp.
namespace piola::geometry {

/// Triangles of the bytes of an STL, OBJ or PLY file; which of them is told by the end of `name`. Corners are
/// multiplied by options.scale; faces with more corners are cut into triangles; lines and points are left out, and
/// `notes` says so. Groups are the objects, groups and materials of an OBJ file and the solids of an STL file. Whatever
/// the bytes are, the answer is a surface of finite corners and valid indices, or `problems` say why not.
Surface surface_of_bytes(std::string_view bytes, std::string const& name, MeshOptions const& options,
                         std::vector<std::string>& problems, std::vector<std::string>& notes);

}  // namespace piola::geometry
