// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/slot_collectives.hpp"
#include "piola/formulations/common/output_fields.hpp"
#include <algorithm>
#include <span>
#include <vector>

namespace piola {

/// Samples one field of the local particles of one body: values[k * components + c] of the k-th. each(f) calls f(slot,
/// particle) for these.
template <class Body, class Each>
void sample_local_slots(Body const& body, OutputField const& field, std::span<double> values, Each const& each) {
  auto const width = static_cast<std::size_t>(field.components);
  each([&](Index i, ParticleOutput const& p) {
    field.put(p, &values[static_cast<std::size_t>(i - body.own().first) * width]);
  });
}

/// Gathers one field of one body on root, values[id * components + c]. each(f) calls f(slot, particle) for the local
/// particles. Collective if the body is distributed.
template <class Body, class Each>
void gather_field_on_root(Body const& body, OutputField const& field, std::span<double> values, Each const& each) {
  if (!body.shared()) return each([&](Index, ParticleOutput const& p) { put(field, p, values); });
  auto const width = static_cast<std::size_t>(field.components);
  Range const own = body.own();
  std::vector<double> mine(static_cast<std::size_t>(own.last - own.first) * width);
  sample_local_slots(body, field, mine, each);
  DistributedSlots{body.slots(), body.particles()}.collect(
      width, std::move(mine), [&](Range part, std::span<double const> of) {
        for (Index i = part.first; i < part.last; ++i)
          std::copy_n(&of[static_cast<std::size_t>(i - part.first) * width], width,
                      &values[static_cast<std::size_t>(body.id(i)) * width]);
      });
}

}  // namespace piola
