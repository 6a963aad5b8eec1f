// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/taylor_sph/boundary_conditions.hpp"
#include "piola/formulations/taylor_sph/cell_mesh.hpp"
#include "piola/neighbours/cross_set_pairs.hpp"
#include <vector>

namespace piola::taylor_sph {

/// Neighbour lists between the real and the virtual particles of one body, for kernel sums; and the distances between
/// the corners of cells at the last update, from which a moving body knows when lists must be updated. The adjoint
/// exchange has no lists, only the distances.
class NeighbourLists {
 public:
  NeighbourLists(Assembly const& assembly, std::size_t body, Options const& options);

  /// Throws InputError if a particle has too few neighbours.
  void build(Points const& x, Particles const& particles, CellMesh const& mesh, Boundary const& boundary, int lanes);
  void set_views(BodyState& state) const;

  int count(Index particle) const { return to_real_.count(particle); }  ///< virtual neighbours of a real particle
  Points const& x() const { return x_; }                                ///< positions at the last update
  std::size_t bytes() const;

 private:
  void build_pairs(Particles const& particles, CellMesh const& mesh, Boundary const& boundary, int lanes);
  void record_distances(Cells const& cells, int lanes);
  bool is_visible(Index particle, Index cell, Points const& X, Cells const& cells) const;

  bool adjoint_;
  double smoothing_length_, skin_;
  std::vector<Crack> cracks_;
  std::vector<std::int8_t> crack_side_;
  Points x_;
  CrossSetPairs to_virtual_, to_real_;
  std::vector<double> reference_square_;
};

}  // namespace piola::taylor_sph
