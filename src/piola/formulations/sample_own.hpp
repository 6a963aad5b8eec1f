// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/observed.hpp"
#include "piola/parallel/own_slots.hpp"
#include <algorithm>
#include <span>
#include <vector>

namespace piola {

/// values[id * components + c] of one field for the particles of one body; each(f) calls f(slot, particle) for those of
/// this rank. On ranks that share the body collective, and rank 0 has them.
template <class Body, class Each>
void sample_own(Body const& body, ObservedField const& field, std::span<double> values, Each const& each) {
  if (!body.shared()) return each([&](Index, ObservedParticle const& p) { put(field, p, values); });
  auto const width = static_cast<std::size_t>(field.components);
  Range const own = body.own();
  std::vector<double> mine(static_cast<std::size_t>(own.last - own.first) * width);
  each([&](Index i, ObservedParticle const& p) {
    field.put(p, &mine[static_cast<std::size_t>(i - own.first) * width]);
  });
  SharedSlots{body.slots(), body.particles()}.collect(
      width, std::move(mine), [&](Range part, std::span<double const> of) {
        for (Index i = part.first; i < part.last; ++i)
          std::copy_n(&of[static_cast<std::size_t>(i - part.first) * width], width,
                      &values[static_cast<std::size_t>(body.id(i)) * width]);
      });
}

}  // namespace piola
