// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/threads.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/cpu_quota.hpp"
#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdlib>
#include <omp.h>
#include <sched.h>
#include <string_view>
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

/// A whole number above 0 from the environment; lists as in OMP_NUM_THREADS=4,2 give their first. 0: there is none.
int number_from(char const* variable) {
  char const* const text = std::getenv(variable);
  if (text == nullptr) return 0;
  std::string_view digits(text);
  digits = digits.substr(std::min(digits.find_first_not_of(' '), digits.size()));
  int value = 0;
  auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  bool const whole = end == digits.data() + digits.size() || *end == ',' || *end == ' ';
  return error == std::errc() && whole && value > 0 ? value : 0;
}

// A thread is worth its start and its barrier only with some thousand particles to work on.
std::atomic<int> min_grain_size{2048};

}  // namespace

int set_threads(int threads) {
  omp_set_dynamic(0);
  omp_set_num_threads(threads > 0 ? threads : automatic_threads());
  return omp_get_max_threads();
}

int threads() { return omp_get_max_threads(); }

int automatic_threads() {
  if (int const wanted = number_from("OMP_NUM_THREADS"); wanted > 0) return wanted;
  auto const cores = static_cast<int>(allowed_cores().size());
  int const granted = number_from("SLURM_CPUS_PER_TASK");
  int const most = std::min(cores > 0 ? cores : omp_get_num_procs(), processor_quota().value_or(omp_get_num_procs()));
  return std::max(1, granted > 0 ? std::min(granted, most) : most);
}

int team_size(int particles) {
  int const worth = particles / min_grain_size.load(std::memory_order_relaxed);
  return std::clamp(worth + 1, 1, omp_get_max_threads());
}

int set_min_grain_size(int particles) {
  PIOLA_EXPECTS(particles >= 1);
  return min_grain_size.exchange(std::max(1, particles));
}

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
