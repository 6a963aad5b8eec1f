// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Cells between the particles of a body: what its interior is, and where it ends.
namespace piola {

using Points = std::vector<std::array<double, 3>>;  ///< positions [m], unused components zero

/// Cells with the same number of corners: simplices (dimension + 1), or boxes of a lattice (2^dimension; corner k is at
/// offset bit 0 of k in x, bit 1 in y, bit 2 in z).
struct Cells {
  int dimension = 0;
  int corners = 0;            ///< per cell
  std::vector<Index> corner;  ///< `corners` per cell: positions in the list of points
  Index count() const { return corners == 0 ? 0 : static_cast<Index>(corner.size()) / corners; }
  std::span<Index const> of(Index cell) const {
    return {corner.data() + static_cast<std::ptrdiff_t>(cell) * corners, static_cast<std::size_t>(corners)};
  }
};

/// Facets that belong to one cell only: the surface of a body, the faces of its cracks included. A facet has
/// `dimension` corners (boxes in 3D are cut into triangles), in the order for which its normal points outwards: in 2D
/// (t_y, -t_x) of t = x_1 - x_0, in 3D the right-hand rule, in 1D the sign in `outward`.
struct Surface {
  int dimension = 0;
  std::vector<Index> corner;    ///< `dimension` per facet
  std::vector<double> outward;  ///< 1D: +1 or -1 per facet
  Index count() const { return dimension == 0 ? 0 : static_cast<Index>(corner.size()) / dimension; }
};

/// The boxes of the lattice of a body all corners of which are particles; corners count from the body's first particle.
/// On cracks each cell takes the particles of its own side.
Cells lattice_cells(ParticleSet const& set, Body const& body);

/// Every box cut into simplices, with diagonals that alternate from box to box: 1D as they are, 2 triangles, 5
/// tetrahedra. `offset`: lattice position of each box, whose parity decides; see lattice_cells.
Cells split_alternately(Cells const& boxes, ParticleSet const& set, Body const& body);

/// Delaunay triangulation (tetrahedralisation in 3D, intervals in 1D) of any points, without what lies outside of the
/// body: simplices whose circumradius is above `largest_radius`, and slivers. Corners are in the order of a positive
/// volume. The same points give the same cells on every machine. Throws InputError: fewer than dimension + 1 points,
/// points that coincide, points on a line (in 3D: in a plane).
Cells delaunay(Points const& points, int dimension, double largest_radius);

/// Moves the corners of cells beside a crack to the particles of their side: after a triangulation in which only one
/// particle of each pair took part. `X`: reference positions; `twin[k]`: the other particle at the same place, or -1.
void open_cracks(Cells& cells, Points const& X, std::vector<std::int8_t> const& side, std::vector<Index> const& twin,
                 std::vector<Crack> const& cracks);

Surface surface_of(Cells const& cells, Points const& points);

/// Signed volume of a cell (area, length): of a simplex exactly, of a box by its simplices [m^dimension].
double volume_of(Cells const& cells, Index cell, Points const& points);

}  // namespace piola
