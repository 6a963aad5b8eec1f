// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/exec/parallel.hpp"
#include <span>

/// A body of which every rank has all slots, in the same order, and works on some of them: what the ranks have to tell
/// each other besides halos. Every function but own_part() is collective, and none does anything on one rank.
namespace piola {

/// The part of a range that this rank works on: of the whole range the same blocks of 64 for any number of ranks.
Range own_part(Range whole);

/// Of values per slot, `size` of slot i at data[i * size], that each rank has right in its own part of a range: all
/// ranks have all of them.
void complete_slots(double* data, std::ptrdiff_t size, Range whole);
/// Of a field that is not tiled.
void complete_slots(FieldRef const& field, int components, Range whole);

/// Of a field that each rank has right in its own slots, a share of them as share_of() has it: rank 0 has all of it.
void gather_slots(FieldRef const& field, Range own, int components);

/// Of a field that each rank has right in its own slots: these slots, which all ranks name in the same order, are right
/// on all of them. For few slots: all ranks have a message as long as the list.
void merge_slots(FieldRef const& field, Range own, std::span<Index const> slots, int components);

/// The first failure that some rank has recorded is everybody's.
void share_failure(FailureSlot& slot);

}  // namespace piola
