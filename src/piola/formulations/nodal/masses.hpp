// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/surface_integrals.hpp"
#include <vector>

namespace piola::nodal {

/// Masses over the density, in units of the spacings: sum_b m_b (1, X, XX) is the integral over the body of (1, X, XX).
/// Cells transfer less mass if a particle would become lighter than `least` of its own cell. The total is exact in any
/// case, the moments with `match` if a small correction suffices. Theory: docs/theory/nodal.md, section 3.4. lattice:
/// the one that the particles fill, if any. shared: distributed particles; then collective, and masses of remote
/// particles are zero.
struct MassInput {
  double least;
  std::optional<LatticeShape> lattice;
  bool match;
  std::optional<DistributedSlots> shared = std::nullopt;
};
template <int D>
LazyZeroArray<double> exact_masses(Points const& X, LazyZeroArray<ScaledCell> const& cells, MassInput const& of);

extern template LazyZeroArray<double> exact_masses<1>(Points const&, LazyZeroArray<ScaledCell> const&,
                                                      MassInput const&);
extern template LazyZeroArray<double> exact_masses<2>(Points const&, LazyZeroArray<ScaledCell> const&,
                                                      MassInput const&);
extern template LazyZeroArray<double> exact_masses<3>(Points const&, LazyZeroArray<ScaledCell> const&,
                                                      MassInput const&);

}  // namespace piola::nodal
