// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/threads.hpp"
#include "piola/math/lanes.hpp"

namespace piola::exec_host {

/// f(k) for the particles k = 0 ... n - 1, for set-up, checkpoints and contact: each call writes what belongs to k
/// alone and throws nothing.
template <class F>
void for_each_in_set_up(Index n, F const& f) {
#pragma omp parallel for schedule(static) num_threads(team(n))
  for (Index k = 0; k < n; ++k) f(k);
}

/// f(k) for the parts k = 0 ... n - 1 of a work on so many particles: rows of a lattice, for example.
template <class F>
void for_each_part_in_set_up(Index n, Index particles, F const& f) {
#pragma omp parallel for schedule(static) num_threads(team(particles))
  for (Index k = 0; k < n; ++k) f(k);
}

}  // namespace piola::exec_host
