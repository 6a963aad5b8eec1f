// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/threads.hpp"
#include <omp.h>
#include <sched.h>
#include <vector>

namespace piola::exec_host {

namespace {

std::vector<int> allowed_cores() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  std::vector<int> cores;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return cores;
  for (int c = 0; c < CPU_SETSIZE; ++c)
    if (CPU_ISSET(c, &allowed)) cores.push_back(c);
  return cores;
}

}  // namespace

int set_threads(int threads) {
  omp_set_dynamic(0);
  omp_set_num_threads(threads > 0 ? threads : omp_get_num_procs());
  return omp_get_max_threads();
}

int threads() { return omp_get_max_threads(); }

void pin_threads() {
  static std::vector<int> const cores = allowed_cores();  // as they were before the first pinning
  if (cores.empty()) return;
#pragma omp parallel
  {
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(cores[static_cast<std::size_t>(omp_get_thread_num()) % cores.size()], &one);
    (void)sched_setaffinity(0, sizeof one, &one);
  }
}

}  // namespace piola::exec_host
