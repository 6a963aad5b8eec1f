// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/communicator.hpp"
#include "piola/exec/device_loops.hpp"
#include "piola/exec/host_loops.hpp"

namespace piola {

/// N reproducible sums over the slots of this rank, or of all ranks if `shared` (then collective). f(slot, x) writes
/// its summands to x[0] ... x[N - 1], which are 0 before.
template <int N, class F>
exec::ReproducibleSums<N> sums_over_slots(bool shared, Range own, F const& f) {
  auto sums = exec_host::parallel_sums<N>(own.last - own.first, [&](Index k, double* x) { f(own.first + k, x); });
  if (shared) comm::allreduce_sum(sums);
  return sums;
}

/// Reproducible sum of f(slot); see sums_over_slots().
template <class F>
double sum_over_slots(bool shared, Range own, F const& f) {
  return sums_over_slots<1>(shared, own, [&](Index i, double* x) { *x = f(i); }).value();
}

}  // namespace piola
