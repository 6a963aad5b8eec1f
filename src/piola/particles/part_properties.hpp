// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/particles/particle_set.hpp"

namespace piola {

/// Size of the region that has the material of a body or of one of its parts.
struct PartProperties {
  std::int64_t particles = 0;
  double volume = 0;  ///< tributary [m^dimension]
};

/// Facts of the region of the body's own material, then of each of its parts.
std::vector<PartProperties> part_properties(ParticleSet const& particles, Body const& body, std::size_t parts);

}  // namespace piola
