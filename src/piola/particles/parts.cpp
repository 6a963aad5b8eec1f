// SPDX-License-Identifier: Apache-2.0
#include "piola/particles/parts.hpp"

namespace piola {

std::vector<PartFacts> part_facts(ParticleSet const& particles, Body const& body, std::size_t parts) {
  std::vector<PartFacts> facts(parts + 1);
  for (std::int64_t id = body.first; id < body.last; ++id) {
    auto const i = static_cast<std::size_t>(id);
    PartFacts& of = facts[part_of(particles, i)];
    ++of.particles;
    of.volume += particles.volume[i];
  }
  return facts;
}

}  // namespace piola
