// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/free_memory.hpp"
#include <cstdlib>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace piola::exec_host {

void give_back_free_memory() {
#if defined(__GLIBC__)
  (void)malloc_trim(0);
#endif
}

void give_back_arrays_at_once() {
#if defined(__GLIBC__)
  (void)mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
}

}  // namespace piola::exec_host
