// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field_view.hpp"
#include "piola/formulations/nodal/list_sums.hpp"
#include "piola/formulations/nodal/state.hpp"

/// Passes over the particles on mirror planes. Theory: docs/theory/nodal.md, section 6.
namespace piola::nodal::inline PIOLA_BACKEND {

/// Whether a component changes its sign in a mirror across `axis`: monomials without the constant, followed by the
/// components of a vector, as in Records.
template <int D>
constexpr bool turns(int m, int axis) {
  constexpr int terms = Quadratic<D>::terms;
  if (m >= terms) return m - terms == axis;
  if (m < D) return m == axis;
  bool odd = false;
  for (int J = 0; J < D; ++J)
    if (J != axis && m == D + Quadratic<D>::at(J, axis)) odd = true;
  return odd;
}

/// The four points of a cell on a plane are not symmetric about it. Averages over them and their images, as in the
/// whole body: only the even components of the stress remain.
template <int D>
struct KeepEven {
  MirroredParticle const* particles;
  WriteView stress;

  PIOLA_FN void operator()(Index n) const {
    MirroredParticle const& p = particles[n];
    for (int axis = 0; axis < D; ++axis) {
      if ((p.axes >> axis & 1) == 0) continue;
      for (int c = 0; c < D; ++c)
        for (int m = 0; m < Records<D>::used; ++m)
          if ((c == axis) != turns<D>(m, axis)) stress.scalar(p.slot, 0.0, c * Records<D>::used + m);
    }
  }
};

/// Keeps particles on a plane in it.
template <int D>
struct StayOnPlanes {
  MirroredParticle const* particles;
  WriteView a;

  PIOLA_FN void operator()(Index n) const {
    MirroredParticle const& p = particles[n];
    for (int axis = 0; axis < D; ++axis)
      if ((p.axes >> axis & 1) != 0) a.scalar(p.slot, 0.0, axis);
  }
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
