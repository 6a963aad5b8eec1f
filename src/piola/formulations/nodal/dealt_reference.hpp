// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/set_up.hpp"
#include "piola/particles/ordering.hpp"

namespace piola::nodal {

/// Permutes the reference of a body from the order `from` to the order `to` of the same particles. Neighbours of a
/// particle keep their order, so sums over them have identical bits. Not for lattices.
Reference dealt_reference(Reference r, SlotOrder const& from, SlotOrder const& to);

}  // namespace piola::nodal
