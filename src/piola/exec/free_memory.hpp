// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace piola::exec_host {

/// Gives memory that set-up has freed back to the system, which the C library would keep for later: what a run takes is
/// then what its arrays take.
void give_back_free_memory();

/// Arrays of a megabyte and more are given back to the system as soon as they are freed. Without this the C library
/// raises that limit to 32 MB as a run frees its first large arrays, and keeps what is freed below it: the largest
/// memory of a run is then a tenth to a fifth larger. For programs, once at their start.
void give_back_arrays_at_once();

/// From now on large arrays (memory.hpp) take memory where somebody comes to them, page by page: for a process that
/// works on one of so many parts of every array. Not while others make arrays. 1, as at the start: whole arrays at
/// once.
void fill_arrays_in_parts(int parts);

}  // namespace piola::exec_host
