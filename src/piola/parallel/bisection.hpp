// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/particles/ordering.hpp"

namespace piola {

/// The order of a body's particles with its leaves of 16 slots (exec::leaf_size) in other places: those of the share of
/// rank 0 (share_of) first, then those of rank 1, and so on, each a compact part of the body, in which they keep their
/// order. Leaves have the particles that they had, and sums start with them, so results do not depend on it; an
/// incomplete one stays at the end. Recursive coordinate bisection (M. J. Berger, S. H. Bokhari, IEEE Trans. Comput.
/// C-36 (1987) 570-580) of whole leaves: a part is cut where the fewest particles lie within reach of the cut, which is
/// as ragged as leaves are long. One rank: the order itself.
SlotOrder bisected(ParticleSet const& set, Body const& body, SlotOrder const& order, int ranks);

/// The pencils of a body (pencil_order), bisected.
inline SlotOrder bisected_pencils(ParticleSet const& set, Body const& body, int ranks) {
  return bisected(set, body, pencil_order(set, body), ranks);
}

}  // namespace piola
