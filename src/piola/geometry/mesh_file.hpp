// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/mesh.hpp"
#include "piola/geometry/mesh_surface.hpp"
#include <string_view>

/// The only file that uses assimp.
namespace piola::geometry {

/// Triangles of the bytes of an STL, OBJ or PLY file; the extension of `name` gives the format. Corners are multiplied
/// by options.scale; faces with more corners are cut into triangles; lines and points are skipped, with a line in
/// `notes`. Groups are the objects, groups and materials of an OBJ file and the solids of an STL file. For any bytes,
/// the result is a surface of finite corners and valid indices, or `problems` gives the reason.
Surface surface_of_bytes(std::string_view bytes, std::string const& name, MeshOptions const& options,
                         std::vector<std::string>& problems, std::vector<std::string>& notes);

}  // namespace piola::geometry
