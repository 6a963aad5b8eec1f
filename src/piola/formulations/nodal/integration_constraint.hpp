// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/halo_plan.hpp"
#include "piola/formulations/nodal/local_fits.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/formulations/nodal/symmetry_reduction.hpp"
#include "piola/neighbours/particle_cells.hpp"
#include <functional>
#include <memory>
#include <vector>

/// The divergence theorem for pair gradients. All lengths in spacings. Theory: docs/theory/nodal.md, section 3.3.
namespace piola::nodal {

/// A cell in units of the spacings.
struct ScaledCell {
  double volume;
  std::array<double, 3> centroid;
  std::array<double, 6> spread;  ///< XX YY ZZ YZ XZ XY
};

/// Corrections of the gradients, G_ab += s_ab (mu_b - p(r_ab).coefficients_a).
struct IntegrationCorrection {
  LazyZeroArray<double> mu;             ///< D per particle; local particles and ghosts
  std::unique_ptr<Field> coefficients;  ///< values x D per local particle: the quadratic through mu about it
  int iterations = 0;
  double before = 0;    ///< largest component of the residual without corrections [faces between two particles]
  double residual = 0;  ///< and of corrected gradients, measured
  double steepest = 0;  ///< largest |G_ab| [1/spacing]
  double rounding = 0;  ///< largest |mu| times |X| times machine precision: error of a strain by sums of x mu
  bool converged = false;

  /// mu_b minus the quadratic about a, along J; p: the monomials of b about a.
  template <int D>
  double unexplained(std::size_t a, std::size_t b, typename LocalFits<D>::Monomials const& p, int J) const {
    auto const i = static_cast<Index>(a);
    double left = mu[b * D + static_cast<std::size_t>(J)] - coefficients->at(i, J);
    for (int m = 1; m < Quadratic<D>::values; ++m)
      left -= coefficients->at(i, m * D + J) * p[static_cast<std::size_t>(m - 1)];
    return left;
  }
};

/// Index of the moments of a patch or a cell (XX YY ZZ YZ XZ XY) for second derivative `at` of D dimensions.
template <int D>
constexpr std::size_t moment_of_second(int at) {
  return D == 2 && at == 2 ? 5 : static_cast<std::size_t>(at);
}

/// Terms of the divergence theorem of a body. On a distributed body, results are valid for local particles; other
/// entries are zero or partial sums.
template <int D>
class IntegrationConstraint {
 public:
  static constexpr int terms = Quadratic<D>::terms, values = Quadratic<D>::values;

  IntegrationConstraint(LocalFits<D> const& fits, LazyZeroArray<ScaledCell> const& cells,
                        std::vector<SurfacePatch> const& patches);

  /// Weights of pressure and traction on the chosen patches per particle, along the outward normals, exact for
  /// quadratic fields: sum_b share_b (1, X, XX) is the integral over these patches. weight(patch): factor of a patch,
  /// zero if not loaded.
  LazyZeroArray<double> shares(std::function<double(SurfacePatch const&)> const& weight) const;
  std::vector<SurfacePatch> const& patches() const { return patches_; }
  std::size_t particles() const { return fits_.X().size(); }
  /// Calls f(b) for the local particles.
  template <class F>
  void for_each_local(F const& f) const {
    for (Index b = fits_.own().first; b < fits_.own().last; ++b) f(static_cast<std::size_t>(b));
  }
  /// Surface vectors A_b, D per particle.
  LazyZeroArray<double> surface_vectors() const;
  /// A_b - sum_a V_a G_ab, D per particle, with the gradients of `corrected` or, if null, without correction. On a
  /// distributed body, `corrected` must have the coefficients of ghosts. `size`: if given, receives the largest |G_ab|
  /// per local particle a.
  LazyZeroArray<double> residual(IntegrationCorrection const* corrected = nullptr,
                                 LazyZeroArray<double>* size = nullptr) const;
  /// Mirror images and halo of a body that has them.
  struct SolveContext {
    SymmetryReduction<D> const* fold = nullptr;
    HaloPlan const* halo = nullptr;  ///< of ghosts, without fields
  };
  /// Computes the smallest change of the gradients that reduces the residual to `tolerance` times its value, by the
  /// loops of an instruction set, over lists or the lattice. Collective on a distributed body. The result is measured;
  /// it may not have converged.
  IntegrationCorrection solve(double tolerance, Backend const& backend, LatticeLayout const* lattice,
                              SolveContext const& whole) const;

 private:
  void measure(IntegrationCorrection& integration_correction, SolveContext const& whole) const;
  LocalFits<D> const& fits_;
  LazyZeroArray<ScaledCell> const& cells_;
  std::vector<SurfacePatch> const& patches_;
};

extern template class IntegrationConstraint<1>;
extern template class IntegrationConstraint<2>;
extern template class IntegrationConstraint<3>;

/// Calls f(b, share) with the weights of particles in the integral of a motion over a patch: an expansion about the
/// nearest particle by its fit.
template <int D, class F>
void each_share(LocalFits<D> const& fits, SurfacePatch const& patch, F const& f) {
  auto const a = static_cast<std::size_t>(patch.particle);
  double own = patch.area;
  for (std::size_t k = fits.pairs().first(a); k < fits.pairs().end(a); ++k) {
    auto const e = fits.derivatives(a, k);
    double moved = 0;
    for (std::size_t i = 0; i < D; ++i) moved += patch.first[i] * e[i];
    for (int m = 0; m < Quadratic<D>::second; ++m)
      moved += patch.second[moment_of_second<D>(m)] * e[std::size_t{D} + m];
    f(fits.pairs().at(k), moved);
    own -= moved;
  }
  f(a, own);
}

/// First derivative along J at the centroid of the cell, from the derivatives at the particle: e_J + sum_K e_JK c_K.
template <int D>
double at_centroid(typename LocalFits<D>::Monomials const& e, ScaledCell const& cell, int J) {
  double g = e[static_cast<std::size_t>(J)];
  for (int K = 0; K < D; ++K)
    g += e[std::size_t{D} + Quadratic<D>::at(J, K)] * cell.centroid[static_cast<std::size_t>(K)];
  return g;
}

}  // namespace piola::nodal
