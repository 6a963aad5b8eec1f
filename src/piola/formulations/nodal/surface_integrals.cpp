// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/surface_integrals.hpp"

namespace piola::nodal {

template <int D>
LazyZeroArray<double> SurfaceIntegrals<D>::shares(std::function<double(SurfacePatch const&)> const& weight) const {
  LazyZeroArray<double> share(fits_.X().size());
  for (auto const& patch : patches_) {
    if (!fits_.has(static_cast<std::size_t>(patch.particle))) continue;  // far from the particles of this rank
    double const counts = weight(patch);
    if (counts == 0) continue;
    each_share<D>(fits_, patch, [&](std::size_t b, double part) { share[b] += counts * part; });
  }
  return share;
}

template <int D>
LazyZeroArray<double> SurfaceIntegrals<D>::surface_vectors() const {
  LazyZeroArray<double> A(fits_.X().size() * D);
  for (int axis = 0; axis < D; ++axis)
    for (bool const upper : {false, true}) {
      auto const share = shares([&](SurfacePatch const& p) { return p.axis == axis && p.upper == upper ? 1.0 : 0.0; });
      for_each_local([&](std::size_t b) { A[b * D + static_cast<std::size_t>(axis)] += upper ? share[b] : -share[b]; });
    }
  return A;
}

template class SurfaceIntegrals<1>;
template class SurfaceIntegrals<2>;
template class SurfaceIntegrals<3>;

}  // namespace piola::nodal
