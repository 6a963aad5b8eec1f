// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/set_up.hpp"
#include "piola/particles/ordering.hpp"

namespace piola::nodal {

/// The reference of a body that was set up in the order `from`, for the order `to` of the same particles. Neighbours of
/// a particle keep the order that they had: sums over them have the same bits. Not of lattices.
Reference dealt_reference(Reference r, SlotOrder const& from, SlotOrder const& to);

}  // namespace piola::nodal
