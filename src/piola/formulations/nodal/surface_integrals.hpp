// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/local_fits.hpp"
#include "piola/formulations/nodal/scaled_body.hpp"
#include <functional>
#include <vector>

/// Integrals over the surface of a body as weights of its particles. All lengths in spacings. Theory:
/// docs/theory/nodal.md, section 3.3.
namespace piola::nodal {

/// On a distributed body, results are valid for local particles; other entries are zero or partial sums.
template <int D>
class SurfaceIntegrals {
 public:
  SurfaceIntegrals(LocalFits<D> const& fits, std::vector<SurfacePatch> const& patches)
      : fits_(fits), patches_(patches) {}

  using Moments = std::array<double, 10>;
  /// Weights of a load on patches per particle, exact for quadratic fields: sum_b share_b (1, X, XX) is the integral
  /// over these patches. moments_of(patch): moments of the load on a patch, those of its extent or of a component of
  /// its normal; all zero if it is not loaded.
  LazyZeroArray<double> shares(std::function<Moments(SurfacePatch const&)> const& moments_of) const;
  std::vector<SurfacePatch> const& patches() const { return patches_; }
  std::size_t particles() const { return fits_.X().size(); }
  /// Calls f(b) for the local particles.
  template <class F>
  void for_each_local(F const& f) const {
    for (Index b = fits_.own().first; b < fits_.own().last; ++b) f(static_cast<std::size_t>(b));
  }
  /// Surface vectors A_b, D per particle.
  LazyZeroArray<double> surface_vectors() const;

 private:
  LocalFits<D> const& fits_;
  std::vector<SurfacePatch> const& patches_;
};

extern template class SurfaceIntegrals<1>;
extern template class SurfaceIntegrals<2>;
extern template class SurfaceIntegrals<3>;

/// Stands for a particle itself where others are positions in its pairs.
constexpr auto itself = static_cast<std::size_t>(-1);

/// Calls f(k, share) with the weights of particles in the integral of a motion over a piece of surface with these
/// moments about particle a: an expansion by the fit of a. `k` is a position in the pairs of a, or `itself`, which
/// comes last.
template <int D, class F>
void each_share(LocalFits<D> const& fits, std::size_t a, std::array<double, 10> const& moments, F const& f) {
  double own = moments[0];
  for (std::size_t k = fits.pairs().first(a); k < fits.pairs().end(a); ++k) {
    auto const e = fits.derivatives(a, k);
    double moved = 0;
    for (std::size_t i = 0; i < D; ++i) moved += moments[1 + i] * e[i];
    for (int m = 0; m < Quadratic<D>::second; ++m) moved += moments[4 + moment_of_second<D>(m)] * e[std::size_t{D} + m];
    f(k, moved);
    own -= moved;
  }
  f(itself, own);
}

/// The particle of a share.
template <int D>
std::size_t particle_of_share(LocalFits<D> const& fits, std::size_t a, std::size_t k) {
  return k == itself ? a : fits.pairs().at(k);
}

}  // namespace piola::nodal
