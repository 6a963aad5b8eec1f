// SPDX-License-Identifier: Apache-2.0
#include "piola/particles/part_properties.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/reproducible_sum.hpp"
#include "piola/particles/body_range.hpp"

namespace piola {

std::vector<PartProperties> part_properties(ParticleSet const& particles, Body const& body, std::size_t parts) {
  PIOLA_EXPECTS(is_range_in(body, particles));
  PIOLA_EXPECTS(particles.volume.size() == particles.X.size());
  PIOLA_EXPECTS(particles.part.empty() || particles.part.size() == particles.X.size());
  std::vector<PartProperties> facts(parts + 1);
  std::vector<exec::ReproducibleSum> volumes(parts + 1);
  for (std::int64_t id = body.first; id < body.last; ++id) {
    auto const i = static_cast<std::size_t>(id);
    std::size_t const part = part_of(particles, i);
    ++facts[part].particles;
    volumes[part] += particles.volume[i];
  }
  for (std::size_t k = 0; k <= parts; ++k) facts[k].volume = volumes[k].value();
  return facts;
}

}  // namespace piola
