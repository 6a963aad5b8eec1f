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

/// How the diagonals of boxes lie: alternating from box to box; or, in 2D, from row to row or from column to column, so
/// that six triangles meet at every particle inside.
enum class Diagonals { by_box, by_row, by_column };

/// Every box cut into simplices, with diagonals that alternate: 1D as they are, 2 triangles, 5 tetrahedra. The parity
/// of a box's lattice position decides, so that the diagonals on a facet equal those of the adjacent box. `boxes`: from
/// lattice_cells of the same body.
Cells split_alternately(Cells const& boxes, ParticleSet const& set, Body const& body,
                        Diagonals diagonals = Diagonals::by_box);

/// Delaunay triangulation (tetrahedralisation in 3D, intervals in 1D) of any points, without what lies outside of the
/// body: simplices whose circumradius is above `largest_radius` [m] (never more than 4 times the diagonal of the box
/// around the points; the radius of an interval is half its length), and slivers on the surface. On a lattice 0.9
/// to 1.5 spacings are right; above 1, single missing particles are filled. Flat tetrahedra inside stay, so that the
/// surface is closed; a regular lattice has none. Diagonals between points on one circle are chosen by the numbers of
/// the points. Corners are in the order of a positive volume, cells in the order of their corners. The same points give
/// the same cells on every machine. Throws InputError: fewer than dimension + 1 points, points that coincide (1e-9 of
/// the extent), points on a line (in 3D: in a plane), positions that are not finite.
Cells delaunay(Points const& points, int dimension, double largest_radius);

/// Moves the corners of cells next to a crack to the particles of their side. Call after a triangulation with only one
/// particle of each doubled pair. `X`: reference positions; `side`: as ParticleSet::crack_side; `twin[k]`: the other
/// particle at the same place, or -1. A cell lies on the side of its centroid; each doubled particle belongs to the
/// crack nearest to it. Cracks must run along edges between particles.
void open_cracks(Cells& cells, Points const& X, std::vector<std::int8_t> const& side, std::vector<Index> const& twin,
                 std::vector<Crack> const& cracks);

/// Facets in the order of their cells. Neither overlapping cells nor facets of more than two cells are expected.
Surface surface_of(Cells const& cells, Points const& points);

/// Signed volume of a cell (area, length): of a simplex, or of the trilinear map of a box, which is the mean of its two
/// cuts into simplices [m^dimension].
double volume_of(Cells const& cells, Index cell, Points const& points);

}  // namespace piola
