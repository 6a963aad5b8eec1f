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

 private:
  LocalFits<D> const& fits_;
  std::vector<SurfacePatch> const& patches_;
};

extern template class SurfaceIntegrals<1>;
extern template class SurfaceIntegrals<2>;
extern template class SurfaceIntegrals<3>;

/// Calls f(b, share) with the weights of particles in the integral of a motion over a patch: an expansion about the
/// nearest particle a by its fit. `b` is a position in pairs() of a, or `none` for a itself, which comes last.
template <int D, class F>
void each_share_of_pair(LocalFits<D> const& fits, SurfacePatch const& patch, F const& f) {
  auto const a = static_cast<std::size_t>(patch.particle);
  double own = patch.area;
  for (std::size_t k = fits.pairs().first(a); k < fits.pairs().end(a); ++k) {
    auto const e = fits.derivatives(a, k);
    double moved = 0;
    for (std::size_t i = 0; i < D; ++i) moved += patch.first[i] * e[i];
    for (int m = 0; m < Quadratic<D>::second; ++m)
      moved += patch.second[moment_of_second<D>(m)] * e[std::size_t{D} + m];
    f(k, moved);
    own -= moved;
  }
  f(static_cast<std::size_t>(-1), own);
}

/// As above; `b` is a particle.
template <int D, class F>
void each_share(LocalFits<D> const& fits, SurfacePatch const& patch, F const& f) {
  each_share_of_pair<D>(fits, patch, [&](std::size_t k, double share) {
    f(k == static_cast<std::size_t>(-1) ? static_cast<std::size_t>(patch.particle) : fits.pairs().at(k), share);
  });
}

}  // namespace piola::nodal
