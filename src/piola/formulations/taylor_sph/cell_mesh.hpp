// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/taylor_sph/particles.hpp"
#include "piola/neighbours/mesh_cells.hpp"
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

namespace piola::taylor_sph {

/// Whether every point of the body's lattice is a particle (particles on cracks count once).
bool is_whole_lattice(ParticleSet const& set, Body const& body);

std::vector<Crack> cracks_of(ParticleSet const& set, std::size_t body);

/// The cell of a slot of virtual particles: cells are numbered by slot, slots without a cell repeat the last one.
inline Index cell_in_slot(Cells const& cells, Index slot) { return std::min(slot, cells.count() - 1); }

double distance(std::array<double, 3> const& a, std::array<double, 3> const& b);
/// Length of the longest edge of a cell; of a box, also of its diagonals.
double longest_edge(std::span<Index const> corners, Points const& x);

/// The cells of one body, whose centres are the virtual particles: simplices between the real particles, or boxes of
/// their lattice. Owns the cells and their tables for loops; the state of cells is in CellFields.
class CellMesh {
 public:
  /// Cells at the start. Throws InputError for shapes that cannot be triangulated.
  CellMesh(Assembly const& assembly, std::size_t body, Particles const& particles, Options const& options);

  /// Takes cells that were made at the positions x, and sorts them so that those near each other follow each other.
  void assign(std::vector<Index> corners, Points const& x);
  /// Tables for these slots of particles.
  void make_tables(Particles const& particles, int lanes);
  void set_views(BodyState& state) const;

  /// Delaunay triangulation of the current positions, restricted to the present cells, which cover the body at any
  /// deformation. None if the cells do not change: those of a lattice, and of a body with cracks.
  std::optional<Cells> triangulate(Points const& x) const;

  Cells const& cells() const { return cells_; }
  Index count() const { return cells_.count(); }
  Points const& x() const { return x_; }  ///< positions at the construction of the cells
  /// Cells around the particle in a slot, of the adjoint exchange.
  int cells_around(Index slot) const;
  /// A particle of the cell with the smallest volume.
  Index worst_corner(Points const& x) const;
  std::size_t bytes() const;

 private:
  void find_cells_around(Particles const& particles);

  bool adjoint_, constant_;
  double largest_radius_;  ///< of a simplex inside the body, at the start [m]
  Cells cells_;            ///< corners numbered within the body
  Points x_;
  std::vector<Index> corner_, around_begin_, around_;
  std::vector<double> reference_quality_;
};

}  // namespace piola::taylor_sph
