// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/communicator.hpp"
#include "piola/formulations/nodal/crack_lines.hpp"
#include "piola/formulations/nodal/surface_integrals.hpp"
#include <vector>

namespace piola::nodal {

/// How well the gradients of a body fulfil what they are built for. Errors are round-off in a sound body.
struct GradientQuality {
  double divergence = 0;  ///< largest component of A_b - sum_a V_a G_ab [faces between two particles]
  double rows = 0;        ///< largest error of a gradient of a quadratic monomial at the centroid of a cell
  double steepest = 0;    ///< largest |G_ab| [1/spacing]
  double enlarged = 0;    ///< particles with a support radius above the usual one

  /// Reduction over ranks.
  void add(GradientQuality const& other) {
    comm::max_or_nan(other.divergence, divergence);
    comm::max_or_nan(other.rows, rows);
    comm::max_or_nan(other.steepest, steepest);
    enlarged += other.enlarged;
  }
};

/// Gradients at the centroids of cells as fluxes through the facets of the cells. The value on a facet between a and b
/// is that of a quadratic fitted to the particles that both see; on the outer surface that of the fit of a. Each cell's
/// surface is closed, so gradients are exact for quadratic fields; each facet belongs to two cells with opposite
/// normals, so the sum over all cells is the surface vector, whatever the cloud. All lengths in spacings. Theory:
/// docs/theory/nodal.md, section 3.3.
template <int D>
class FacetFluxes {
 public:
  /// cracks: of a body whose cells may fail; the fits are then of a cloud, and know the lines that cracks block.
  /// Enlarges support radii of `fits` until the fits on all facets are well conditioned; fits.unsolvable() tells a
  /// particle where this is impossible. Collective on a distributed body.
  FacetFluxes(LocalFits<D>& fits, ScaledBody const& body, CrackLines const* cracks = nullptr);
  /// Computes the fluxes of a cell again, after cells near it have failed. Some of its facets are then
  /// surface (CrackLines::is_face); a detached cell has no fluxes. Returns whether they have changed.
  bool refill(std::size_t a);
  /// Calls f(b) for the particles whose cells have a facet with that of a.
  template <class F>
  void each_beside(std::size_t a, F const& f) const {
    for (std::size_t const k : facets_.of(a)) {
      auto const low = static_cast<std::size_t>(body_.facets[k].a), high = static_cast<std::size_t>(body_.facets[k].b);
      f(a == low ? high : low);
    }
  }

  /// V_a G_ab along J for pair k of a, a position in pairs() of the fits.
  double flux(std::size_t a, std::size_t k, int J) const {
    std::size_t const from = fits_.representative(a);
    return flux_[(k - fits_.pairs().first(a) + fits_.pairs().first(from)) * D + static_cast<std::size_t>(J)];
  }
  /// Measured over the local particles, without images. Collective on a distributed body.
  GradientQuality measure(SurfaceIntegrals<D> const& surface) const;

 private:
  static constexpr int values = Quadratic<D>::values;
  using Row = std::array<double, static_cast<std::size_t>(values)>;
  /// A particle that may see a facet of a: itself, or its pair `k`.
  struct Candidate {
    std::size_t particle, k;
  };

  bool fill_row(std::size_t a);
  std::vector<Candidate> candidates_of(std::size_t a) const;
  bool add_facet(std::size_t a, CellFacet const& facet, std::vector<Candidate> const& candidates);
  void add_surface(SurfacePatch const& patch);
  void add_crack_face(std::size_t a, CellFacet const& facet);
  template <int N>
  struct Member {
    std::size_t k;  ///< position in the pairs of a, or itself
    double weight;
    std::array<double, static_cast<std::size_t>(N)> p;
  };
  std::vector<Member<values>> members_of(std::size_t other, CellFacet const& facet,
                                         std::vector<Candidate> const& candidates) const;
  template <int N>
  bool add_members(CellFacet const& facet, double sign, std::vector<Member<N>> const& members, double worst);
  /// Calls f(k, share) with the weights of particles in the integral of a radial field over the section of cell a, as
  /// each_share(). The flux of R f through the surface of a cell is int (R df/dR + f) dA.
  template <class F>
  void each_hoop_share(std::size_t a, F const& f) const;
  double error_of_row(std::size_t a) const;

  LocalFits<D>& fits_;
  ScaledBody const& body_;
  CrackLines const* cracks_;
  ItemsOfParticles facets_, patches_;
  std::vector<double> flux_;  ///< D per pair; on a lattice only those of representatives are filled
};

extern template class FacetFluxes<1>;
extern template class FacetFluxes<2>;
extern template class FacetFluxes<3>;

}  // namespace piola::nodal
