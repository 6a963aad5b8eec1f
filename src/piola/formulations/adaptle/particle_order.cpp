// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/particle_order.hpp"
#include "piola/particles/ordering.hpp"

namespace piola::adaptle {

ParticleOrder::ParticleOrder(ParticleSet const& set) {
  if (current_shuffle().owners == 0) return;
  slot_.resize(at(set.size()));
  for (Body const& body : set.bodies)
    for (std::size_t const number : shuffled_indices(at(body.last - body.first), current_shuffle())) {
      slot_[at(body.first) + number] = static_cast<Index>(id_.size());
      id_.push_back(body.first + static_cast<std::int64_t>(number));
    }
}

}  // namespace piola::adaptle
