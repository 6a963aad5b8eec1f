// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/closure.hpp"
#include <vector>

namespace piola::nodal {

/// Masses over the density, in units of the spacings: sum_b m_b (1, X, XX) is the integral over the body of (1, X, XX).
/// Cells that would make a particle lighter than `least` of its own cell hand over less; the total is exact in any
/// case, the rest with `match` where a small correction can do it. Theory: docs/theory/nodal.md, section 3.4. lattice:
/// the one that the particles fill, if they do.
template <int D>
std::vector<double> exact_masses(Points const& X, std::vector<ScaledCell> const& cells, double least,
                                 std::optional<LatticeShape> const& lattice, bool match);

extern template std::vector<double> exact_masses<1>(Points const&, std::vector<ScaledCell> const&, double,
                                                    std::optional<LatticeShape> const&, bool);
extern template std::vector<double> exact_masses<2>(Points const&, std::vector<ScaledCell> const&, double,
                                                    std::optional<LatticeShape> const&, bool);
extern template std::vector<double> exact_masses<3>(Points const&, std::vector<ScaledCell> const&, double,
                                                    std::optional<LatticeShape> const&, bool);

}  // namespace piola::nodal
