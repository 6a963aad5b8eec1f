// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/reference_mesh.hpp"
#include "piola/math/tensor.hpp"
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace piola {

/// When a cell of the mesh is torn: an edge is longer than `stretch` times its length in the reference configuration,
/// and the cell has opened (at a corner, its volume has grown to more than `growth` times what it was), or is sheared
/// off (an edge is longer than `sheared_off` times). Stretch alone is not sufficient: plastic metal is drawn out to
/// three times its length with less than a tenth of change in volume, while a gap adds volume.
struct TearingCriterion {
  double stretch, growth, sheared_off;
};
inline constexpr TearingCriterion tearing{2.5, 2, 8};
/// A torn cell is whole again below all of these bounds. Between both sets of bounds it keeps its state, so that skins
/// do not flicker from picture to picture.
inline constexpr TearingCriterion joining{2, 1.5, 6};

/// Particles of one body at one time: positions [m], and a flag of those permanently without neighbours (not 0; empty:
/// none). Does not own the arrays.
struct Configuration {
  std::span<Point3 const> x;
  std::span<std::uint8_t const> loose;
  std::optional<std::span<Index const>> torn = {};  ///< torn cells in ascending order; nothing: determined by the
                                                    ///< bounds `tearing`
  /// Edges of cells that are whole although these are longer than tearing.stretch, each with its lower end first,
  /// rising.
  std::span<std::array<Index, 2> const> drawn_out = {};
};

/// Torn cells in ascending order: above the bounds `tearing`, with a loose or NaN particle, or torn before (`before`,
/// ascending) and not below `joining`.
std::vector<Index> torn_cells(ReferenceMesh const& mesh, Configuration const& now, std::span<Index const> before);

/// F of a particle: the linear map that best fits the positions of its mesh neighbours (least squares over edges that
/// are not longer than tearing.stretch, or drawn out). A small weight of the identity determines directions without
/// neighbours. Exact to 1e-3 of F - I for a linear motion.
Mat<3> fitted_gradient(ReferenceMesh const& mesh, Configuration const& now, std::size_t particle);

/// Bounds of the principal stretches of balls in pictures and pages.
inline constexpr double least_ball_stretch = 1.0 / 3, most_ball_stretch = 4;

/// F with its principal stretches brought between these bounds.
Mat<3> with_bounded_stretches(Mat<3> const& F, double least, double most);

/// A triangle of a body's surface, in 2D of its inside. Corners are particles, counted from the body's first one; see
/// Skin::particle for others.
struct SkinFacet {
  std::array<Index, 3> corner{};
  std::array<Point3, 3> normal{};  ///< at the corners; smooth but for edges of more than 55 degrees
};

/// Surface of a body at one time.
struct Skin {
  std::vector<Point3> place;         ///< of each corner, at the surface for outer particles: x + F S [m]
  std::vector<Point3> reference;     ///< the same in the reference configuration: X + S
  std::vector<std::uint8_t> whole;   ///< per cell: not torn
  std::vector<std::uint8_t> inside;  ///< per particle: belongs to a whole cell, so that it needs no ball
  std::vector<SkinFacet> facets;
  std::vector<Index> particle = {};  ///< of each corner; empty: corner i is that of particle i

  std::size_t particle_of(std::size_t corner) const {
    return particle.empty() ? corner : static_cast<std::size_t>(particle[corner]);
  }
};

/// Computes the skin: outer facets of the cells that are not torn; in 2D all of these cells. At a tear the skin extends
/// half a cell beyond its last particles, mapped by F. So a gap has its true width, and cells that count as torn but
/// have not opened (damage, conversion) leave no gap.
Skin make_skin(ReferenceMesh const& mesh, Configuration const& now);

/// The section of a body of three dimensions with the surface on which `beyond`, one value per particle, is zero:
/// triangles whose corners are mixed from two particles each.
struct SectionCorner {
  std::array<Index, 2> particle{};
  double share = 0;  ///< of the second one
};
std::vector<std::array<SectionCorner, 3>> section(ReferenceMesh const& mesh, Skin const& skin,
                                                  std::span<double const> beyond);

}  // namespace piola
