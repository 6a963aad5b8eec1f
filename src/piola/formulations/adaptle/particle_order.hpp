// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/subscript.hpp"
#include "piola/particles/particle_set.hpp"
#include <cstdint>
#include <vector>

namespace piola::adaptle {

/// Order of particles in memory. Those of a body are contiguous. Tests shuffle the tiles of a body (Shuffle,
/// particles/ordering.hpp); else slots are ids, without additional memory.
class ParticleOrder {
 public:
  explicit ParticleOrder(ParticleSet const& set);
  bool dealt() const { return !id_.empty(); }
  std::size_t id(Index slot) const { return dealt() ? static_cast<std::size_t>(id_[at(slot)]) : at(slot); }
  Index slot(std::int64_t id) const { return dealt() ? slot_[at(id)] : static_cast<Index>(id); }
  std::int64_t const* ids() const { return dealt() ? id_.data() : nullptr; }  ///< per slot; null: slots are ids
  Index const* slots() const { return dealt() ? slot_.data() : nullptr; }     ///< per id; null: slots are ids
  std::size_t bytes() const { return id_.size() * sizeof(std::int64_t) + slot_.size() * sizeof(Index); }

 private:
  std::vector<std::int64_t> id_;
  std::vector<Index> slot_;
};

}  // namespace piola::adaptle
