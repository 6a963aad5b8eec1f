// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/closure.hpp"
#include <vector>

namespace piola::nodal {

/// Masses over the density, in units of the spacings: sum_b m_b (1, X, XX) is the integral over the body of (1, X, XX).
/// Cells transfer less mass if a particle would become lighter than `least` of its own cell. The total is exact in any
/// case, the moments with `match` if a small correction suffices. Theory: docs/theory/nodal.md, section 3.4. lattice:
/// the one that the particles fill, if any. shared: distributed particles; then collective, and masses of remote
/// particles are zero.
struct MassesOf {
  double least;
  std::optional<LatticeShape> const& lattice;
  bool match;
  std::optional<SharedSlots> shared = std::nullopt;
};
template <int D>
PartFilled<double> exact_masses(Points const& X, PartFilled<ScaledCell> const& cells, MassesOf const& of);

extern template PartFilled<double> exact_masses<1>(Points const&, PartFilled<ScaledCell> const&, MassesOf const&);
extern template PartFilled<double> exact_masses<2>(Points const&, PartFilled<ScaledCell> const&, MassesOf const&);
extern template PartFilled<double> exact_masses<3>(Points const&, PartFilled<ScaledCell> const&, MassesOf const&);

}  // namespace piola::nodal
