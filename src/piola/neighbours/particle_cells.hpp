// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <functional>
#include <vector>

/// Cells of particles: the points of the undeformed body that are nearer to one particle than to any other, distances
/// measured in spacings. Integrals over them and over the parts of the surface that belong to them.
namespace piola {

/// A particle's cell.
struct CellMoments {
  double volume = 0;                 ///< [m^D]
  std::array<double, 3> centroid{};  ///< relative to the particle [m]
  std::array<double, 6> spread{};    ///< central second moments over the volume [m2]: XX YY ZZ YZ XZ XY
};

/// Integrals of N_J (1, r, r1^2/2, r2^2/2, r3^2/2, r2 r3, r1 r3, r1 r2) dA over a piece of a cell's surface with the
/// normal N, for J = 1, 2, 3 [m^(D-1) and more]. In axisymmetric bodies dA is that of the ring, 2 pi R ds.
using NormalMoments = std::array<std::array<double, 10>, 3>;

/// The part of a cell's surface on one patch of the body's surface; or, where patches are not known, the part that
/// faces one direction of an axis.
struct SurfacePatch {
  Index particle = 0;               ///< counted from the body's first
  int patch = -1;                   ///< its number, see Outline::patches; -1: not known
  int axis = 0;                     ///< of the outward normal where the patch is not known
  bool upper = false;               ///< that normal points to larger coordinates
  bool outermost = false;           ///< on the box around the body: part of one of its flat faces
  NormalMoments moments{};          ///< with the outward normal, r from the particle
  std::array<double, 10> extent{};  ///< the same with |N| for N_J
};

/// The surface between the cells of two particles, N from a to b, r from the middle between the two particles.
struct CellFacet {
  Index a = 0, b = 0;  ///< counted from the body's first; a < b
  NormalMoments moments{};
};

/// Integrals of 2 pi r1^i r2^j dA over the cross-section of a ring, r from the particle [m2 and more].
struct SectionMoments {
  static constexpr std::array<std::array<int, 2>, 10> powers{
      {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}}};
  std::array<double, powers.size()> of{};  ///< in the order of `powers`

  /// Index of the powers (i, j).
  static constexpr std::size_t at(int i, int j) {
    int const degree = i + j;
    return static_cast<std::size_t>(degree * (degree + 1) / 2 + j);
  }
};

struct BodyCells {
  std::vector<CellMoments> cell;        ///< per particle of the body
  std::vector<SectionMoments> section;  ///< of axisymmetric bodies, per particle
  std::vector<SurfacePatch> patch;
  std::vector<CellFacet> facet;
  // Bodies with known patches: corners of blocks are moved onto the surface.
  double farthest_move = 0;  ///< [spacings]
  std::int64_t unmoved = 0;  ///< corners too far from the surface, which stay where they were
};

/// Whether cells are the blocks of a lattice: a box that one fills.
inline bool has_lattice_cells(Body const& body) { return body.regular && !body.off_lattice && !body.outline.inside; }

/// Exact for boxes filled from a lattice. Others are sampled by blocks of a sixth of the spacing, aligned with the box
/// around them; corners of blocks at a surface with known patches are moved onto it, onto edges and corners included,
/// so that bodies with flat faces are exact. Every cell is closed by itself, and the divergence theorem holds for
/// quadratic fields to round-off. Needs Body::outline. Cells may be without a block. wants_facets(particle): whether
/// the facets of a particle are kept, counted from the body's first; none: of no particle.
BodyCells measure_cells(ParticleSet const& set, Body const& body,
                        std::function<bool(std::size_t)> const& wants_facets = {});

/// Gives the particles of a body the volumes of their cells.
void take_cell_volumes(ParticleSet& set, Body const& body);

}  // namespace piola
