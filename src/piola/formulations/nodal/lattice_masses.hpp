// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/scaled_body.hpp"
#include <optional>

namespace piola::nodal {

/// Masses over the density, in units of the spacings, of a lattice that fills a box: the product over the axes of the
/// masses of a line of particles, so that moments are exact up to the second. Empty if an axis has fewer than four
/// particles, or if a particle would be lighter than `least` of its cell: then exact_masses() serves.
std::optional<LazyZeroArray<double>> lattice_masses(ScaledBody const& body, int dimension, double least);

}  // namespace piola::nodal
