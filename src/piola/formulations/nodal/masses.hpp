// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/closure.hpp"
#include <vector>

namespace piola::nodal {

/// Masses over the density, in units of the spacings: sum_b m_b (1, X, XX) is the integral over the body of (1, X, XX).
/// Cells that would make a particle lighter than `least` of its own cell hand over less; the total is exact in any
/// case, the rest with `match` where a small correction can do it. Theory: docs/theory/nodal.md, section 3.4. lattice:
/// the one that the particles fill, if they do. shared: ranks share the particles; each has the masses of its own then,
/// and of others zeros. Collective then.
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
