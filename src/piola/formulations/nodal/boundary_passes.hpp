// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/passes.hpp"
#include "piola/math/embedding.hpp"
#include "piola/mechanics/boundary_passes.hpp"

/// Passes for loads on particles, in addition to those of mechanics/. Theory: docs/theory/boundaries.md.
namespace piola::nodal::inline PIOLA_BACKEND {

/// Accelerations by follower pressures at the start or at the end of a step: along n da = cof F N dA (Nanson), with F
/// at the particle. The weights of a face are exact for quadratic fields at particles, and so for the area vectors of a
/// quadratic deformation.
template <int D>
struct TurnLoads {
  static constexpr int second = Quadratic<D>::second;
  bool at_end;
  LoadedParticle* loaded;
  double const* centroid;  ///< [loaded][D]: of the cell, relative to the particle [m]
  double const* radius;    ///< [loaded]: reference radius, 0 on the axis [m]; nullptr: not axisymmetric
  ListSums<D> list;
  ReferenceView k;
  View offset, x;

  PIOLA_FN void operator()(Index n) const {
    using R = Records<D>;
    LoadedParticle& p = loaded[n];
    double rows[D * R::width];
    list.of_motion(p.slot, rows);
    Mat<D> F;
    for (int c = 0; c < D; ++c) {
      double const* const T = rows + c * R::width;
      double H[second]{};
      for (int m = 0; m < R::terms; ++m)
        for (int s = 0; s < second; ++s) H[s] += T[m] * k.template scalar<double>(p.slot, m * second + s);
      for (int J = 0; J < D; ++J) {
        F(c, J) = T[R::terms + J] + (offset.data == nullptr ? 0 : offset.scalar<double>(p.slot, c * D + J));
        for (int K = 0; K < D; ++K) F(c, J) -= H[Quadratic<D>::at(J, K)] * centroid[n * D + K];
      }
    }
    Mat<3> whole = embed<D>(F);
    if (radius != nullptr) whole(2, 2) = radius[n] > 0 ? x.scalar<double>(p.slot) / radius[n] : F(0, 0);
    turn_load<D>(p, at_end, cofactor(whole));
  }
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
