// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/heap_tuning.hpp"
#include <cstdlib>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace piola::exec_host {

void trim_heap() {
#if defined(__GLIBC__)
  (void)malloc_trim(0);
#endif
}

void set_mmap_threshold() {
#if defined(__GLIBC__)
  (void)mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
}

}  // namespace piola::exec_host
