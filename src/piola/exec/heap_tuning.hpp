// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace piola::exec_host {

/// Returns freed memory that the C library keeps to the system (malloc_trim), so that the memory of a run is that of
/// its arrays.
void trim_heap();

/// Returns arrays of 1 MB and more to the system as soon as they are freed. By default the C library raises that
/// threshold to 32 MB as a run frees its first large arrays, which increases the peak memory of a run by a tenth to a
/// fifth. For programs, once at their start.
void set_mmap_threshold();

/// Sets the allocation policy of large arrays (memory.hpp). `parts` > 1: pages are allocated on first touch, for a
/// process that uses about 1/parts of each array. 1 (default): whole arrays. Not thread-safe against allocation.
void set_lazy_allocation(int parts);

}  // namespace piola::exec_host
