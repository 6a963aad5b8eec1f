// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/solid.hpp"
#include <cstdint>
#include <numbers>
#include <string_view>

/// Bodies from surfaces of triangles. A build without PIOLA_MESH has these functions, and they report that.
namespace piola::geometry {

struct MeshOptions {
  enum class Repair {
    none,
    orient,  ///< faces are turned until neighbours agree and normals point outwards
    holes,   ///< holes are allowed up to largest_hole, and rays decide between inside and outside
    faces    ///< duplicate faces and faces without area are removed, the rest turned as by orient
  };
  double scale = 1;                             ///< [m] per unit of the file
  double feature_angle = std::numbers::pi / 6;  ///< patches end where normals turn by more [rad]
  Repair repair = Repair::none;                 ///< what may be mended
  double largest_hole = 0;                      ///< for Repair::holes [m]
  double merge = 0;                             ///< corners nearer than this become one [m]; 0: only equal ones
  double spacing = 0;                           ///< of the particles to come [m]; 0: no remarks about it
  double time_limit = 5;                        ///< time limit of reading, plus 1 s per MB [s]; 0: none
};

/// Result of reading a mesh. Texts begin with the name of the file, without its folder.
struct MeshReport {
  std::vector<std::string> problems;  ///< all errors that forbid the use of the mesh
  std::vector<std::string> notes;     ///< remarks that forbid nothing
  std::int64_t corners = 0, faces = 0, shells = 0;
  std::int64_t dropped = 0;  ///< faces with equal corners
  std::int64_t open = 0, non_manifold = 0,
               turned = 0;                   ///< edges: used once, more than twice, between faces turned about
  std::int64_t mended = 0;                   ///< faces turned by Repair::orient, Repair::faces
  std::int64_t merged = 0;                   ///< corners merged with nearby ones
  std::int64_t twice = 0, without_area = 0;  ///< faces removed by Repair::faces
  double longest_hole = 0;                   ///< [m]
  double volume = 0, area = 0;               ///< [m3, m2]
  Bounds bounds;
};

/// The body inside the surface of an STL (binary or text), OBJ or PLY file. Null if there are problems. Its distance is
/// exact to round-off for closed surfaces, its volume too; with Repair::holes it has no exact volume.
/// Tested in tests/geometry/mesh_test.cpp, mesh_distance_test.cpp and mesh_broken_test.cpp.
SolidPtr read_mesh(std::string const& path, MeshOptions const& options, MeshReport& report);

/// As read_mesh(), for the content of a file. The extension of `name` gives the format.
SolidPtr mesh_from_bytes(std::string_view bytes, std::string const& name, MeshOptions const& options,
                         MeshReport& report);

}  // namespace piola::geometry
