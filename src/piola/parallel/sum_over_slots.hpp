// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/parallel.hpp"
#include "piola/exec/set_up_loop.hpp"
#include "piola/parallel/ranks.hpp"

namespace piola {

/// The exact sum of f(slot) over the slots of this rank, and over those of all ranks if they share the body: then all
/// ranks call it.
template <class F>
double sum_over_slots(bool shared, Range own, F const& f) {
  auto sum = exec_host::sums_of<1>(own.last - own.first, [&](Index k, double* x) { *x = f(own.first + k); });
  if (shared) ranks::add(sum);
  return sum.value();
}

}  // namespace piola
