// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/particles/ordering.hpp"

namespace piola {

/// Permutes the leaves (exec::leaf_size = 16 slots) of an order of a body's particles, so that each rank's partition
/// (even_range_of_rank) is compact. Slots of rank 0 come first, then those of rank 1, and so on; leaves of a rank keep
/// their order. Leaves keep their particles and sums start with leaves, so results do not depend on the permutation. An
/// incomplete leaf stays at the end. Recursive coordinate bisection of whole leaves (M. J. Berger, S. H. Bokhari, IEEE
/// Trans. Comput. C-36 (1987) 570-580): each cut is placed where the fewest particles lie within the support radius of
/// it. One rank: returns `order`.
SlotOrder bisected(ParticleSet const& set, Body const& body, SlotOrder const& order, int ranks);

}  // namespace piola
