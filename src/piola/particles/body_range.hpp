// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/particles/particle_set.hpp"

namespace piola {

/// Whether the ids of a body are those of particles of the set.
inline bool is_range_in(Body const& body, ParticleSet const& particles) {
  return body.first >= 0 && body.first <= body.last && body.last <= particles.size();
}

}  // namespace piola
