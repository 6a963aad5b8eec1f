// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <ctime>

namespace piola::exec_host {

/// Processor time of all threads of this program [s].
inline double processor_time() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace piola::exec_host
