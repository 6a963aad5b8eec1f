// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/solid.hpp"
#include <array>
#include <functional>

namespace piola::geometry {

/// Triangles with numbered corners; in 2D lines, whose third number is unused.
struct Triangles {
  std::vector<Vec<3>> corner;
  std::vector<std::array<int, 3>> face;  ///< anticlockwise from outside
};

/// Zero surface of a function in a box. Cubes of about `edge` [m] are divided into six tetrahedra each (squares into
/// two triangles), which planes intersect. Closed if the function is positive on the faces of the box, which counts as
/// surrounded by positive values. Calls the function from several threads.
Triangles level_surface(std::function<double(Vec<3> const&)> const& value, Bounds const& box, double edge,
                        int dimension);

/// The triangles as pieces of patch 0, with corners that may have been moved.
void append_pieces(Triangles const& triangles, std::vector<Vec<3>> const& corner, int dimension,
                   std::vector<SurfacePiece>& pieces);

}  // namespace piola::geometry
