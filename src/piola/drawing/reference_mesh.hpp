// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/point3.hpp"
#include "piola/neighbours/mesh_cells.hpp"
#include <cstddef>
#include <span>
#include <vector>

namespace piola {

using Polyline = std::vector<Point3>;

/// Smooth edge between two outer facets: an outline if one faces the viewer and the other does not.
struct RoundEdge {
  std::array<Index, 2> ends{};
  std::array<Point3, 2> normal{};
};

/// Mesh that connects the particles of a body in the reference configuration, for skins. Indices are relative to the
/// body's first particle.
struct ReferenceMesh {
  std::size_t first = 0, count = 0;  ///< particles of the body in the run
  int dimension = 3;
  double spacing = 0;              ///< the largest of the lattice [m]
  Points X;                        ///< [m]
  Cells cells;                     ///< boxes of the lattice, or simplices; none: particles are drawn as balls
  std::vector<Index> across;       ///< per cell and facet: the cell on the other side, or -1
  std::vector<Point3> outward;     ///< from particles at the surface to the surface of the shape [m]; else zero
  std::vector<std::size_t> begin;  ///< where the neighbours of a particle begin; one more at the end
  std::vector<Index> neighbour;    ///< particles that share an edge of a cell

  std::vector<Polyline> lines;   ///< edges of the reference shape, see feature_lines
  std::vector<RoundEdge> round;  ///< of its surface where it is smooth

  std::span<Index const> around(std::size_t particle) const {
    return std::span(neighbour).subspan(begin[particle], begin[particle + 1] - begin[particle]);
  }
};

/// Cells of the lattice if there is one, else of a Delaunay triangulation without the cells outside the body. Outer
/// particles are moved to the surface of the shape along the normals of adjacent facets, to 1e-3 spacings. Particles on
/// a line, too few, or in the same place have no cells.
ReferenceMesh reference_mesh(ParticleSet const& set, Body const& body);
std::vector<ReferenceMesh> reference_meshes(ParticleSet const& set);

/// Edges of a kind of cell, pairs of its corners.
std::span<std::array<int, 2> const> edges_of(Cells const& cells);

}  // namespace piola
