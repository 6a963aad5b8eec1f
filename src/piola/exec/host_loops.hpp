// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/exec/reproducible_sum.hpp"
#include "piola/exec/threads.hpp"
#include "piola/math/lanes.hpp"

namespace piola::exec_host {

/// Parallel loop of the host over k = 0 ... n - 1. f must be thread-safe and must not throw.
template <class F>
void parallel_for(Index n, F const& f) {
#pragma omp parallel for schedule(static) num_threads(team_size(n))
  for (Index k = 0; k < n; ++k) f(k);
}

/// As above for i = r.first ... r.last - 1.
template <class F>
void parallel_for(Range r, F const& f) {
  parallel_for(r.last - r.first, [&](Index k) { f(r.first + k); });
}

/// Parallel loop over parts k = 0 ... n - 1, e.g. rows of a lattice, with the team for `particles` particles. f must be
/// thread-safe and must not throw.
template <class F>
void parallel_for_chunks(Index n, Index particles, F const& f) {
#pragma omp parallel for schedule(static) num_threads(team_size(particles))
  for (Index k = 0; k < n; ++k) f(k);
}

/// N reproducible sums over k = 0 ... n - 1. f(k, x) writes its summands to x[0] ... x[N - 1], which are 0 before. The
/// bits do not depend on the number of threads. f must not throw.
template <int N, class F>
exec::ReproducibleSums<N> parallel_sums(Index n, F const& f) {
  exec::ReproducibleSums<N> all;
#pragma omp parallel num_threads(team_size(n))
  {
    exec::ReproducibleSums<N> mine;
#pragma omp for schedule(static) nowait
    for (Index k = 0; k < n; ++k) {
      double x[N]{};
      f(k, x);
      mine.add(x);
    }
#pragma omp critical(piola_exact_sums)
    all.add(mine);
  }
  return all;
}

/// Reproducible sum of f(k) over k = 0 ... n - 1.
template <class F>
double parallel_sum(Index n, F const& f) {
  return parallel_sums<1>(n, [&](Index k, double* x) { *x = f(k); }).value();
}

}  // namespace piola::exec_host
