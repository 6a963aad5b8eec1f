// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/surface_integrals.hpp"

namespace piola::nodal {

template <int D>
LazyZeroArray<double> SurfaceIntegrals<D>::shares(std::function<Moments(SurfacePatch const&)> const& moments_of) const {
  LazyZeroArray<double> share(fits_.X().size());
  for (auto const& patch : patches_) {
    auto const a = static_cast<std::size_t>(patch.particle);
    if (!fits_.has(a)) continue;  // far from the particles of this rank
    Moments const moments = moments_of(patch);
    if (moments == Moments{}) continue;
    each_share<D>(fits_, a, moments,
                  [&](std::size_t k, double part) { share[particle_of_share<D>(fits_, a, k)] += part; });
  }
  return share;
}

template <int D>
LazyZeroArray<double> SurfaceIntegrals<D>::surface_vectors() const {
  LazyZeroArray<double> A(fits_.X().size() * D);
  for (std::size_t J = 0; J < D; ++J) {
    auto const share = shares([J](SurfacePatch const& p) { return p.moments[J]; });
    for_each_local([&](std::size_t b) { A[b * D + J] = share[b]; });
  }
  return A;
}

template class SurfaceIntegrals<1>;
template class SurfaceIntegrals<2>;
template class SurfaceIntegrals<3>;

}  // namespace piola::nodal
