// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/mesh.hpp"
#include "piola/geometry/mesh_distance.hpp"

namespace piola::geometry {

/// Checks faces and edges of a welded surface. Adds all errors to report.problems.
void check_links(Surface const& surface, Links const& links, std::string const& name, MeshOptions const& options,
                 MeshReport& report);

/// Whether the surface passes through itself: at random places and next to faces, ray crossings and normals must agree
/// on inside and outside. Finds intersections larger than about a face.
void check_crossing(Surface const& surface, MeshDistance const& distance, std::string const& name, MeshReport& report);

/// Notes about the size of the mesh and its thinnest wall against the spacing.
void compare_with_spacing(Surface const& surface, MeshDistance const& distance, std::string const& name, double spacing,
                          MeshReport& report);

}  // namespace piola::geometry
