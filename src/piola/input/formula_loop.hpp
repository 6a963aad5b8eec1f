// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/host_loops.hpp"
#include "piola/exec/threads.hpp"
#include "piola/particles/particle_set.hpp"
#include <algorithm>
#include <vector>

namespace piola {

/// f(formulas, id) for the particles of a body, in all threads: one expression must not be evaluated by two threads at
/// once, so that each has its own copy of them. f writes what belongs to the particle alone and throws nothing.
template <class Formulas, class F>
void for_each_with_formulas(Formulas const& formulas, Body const& body, F const& f) {
  auto const particles = static_cast<Index>(body.last - body.first);
  Index const parts = exec_host::team_size(particles);
  if (parts <= 1) {  // every copy compiles its formula again
    for (auto id = body.first; id < body.last; ++id) f(formulas, static_cast<std::size_t>(id));
    return;
  }
  std::vector<Formulas> const copies(static_cast<std::size_t>(parts), formulas);
  exec_host::parallel_for_chunks(parts, particles, [&](Index part) {
    auto const share = [&](Index k) { return body.first + static_cast<std::int64_t>(particles) * k / parts; };
    for (auto id = share(part); id < share(part + 1); ++id)
      f(copies[static_cast<std::size_t>(part)], static_cast<std::size_t>(id));
  });
}

}  // namespace piola
