// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/neighbours/cell_grid.hpp"
#include "piola/particles/particle_set.hpp"
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace piola::adaptle {

/// Marks the particles that have lost their surface contact: Eulerian ones, and those with an Eulerian reference
/// neighbour. Used if bodies have surface contact first. Replicated.
class LostSurfaces {
 public:
  LostSurfaces() = default;
  explicit LostSurfaces(ParticleSet const& set) : lost_(set.X.size(), 0) {}
  bool used() const { return !lost_.empty(); }
  std::int64_t count() const { return count_; }
  /// By slot: 1 if lost; empty if no bodies have surface contact first.
  std::vector<std::uint8_t> const& by_slot() const { return lost_; }
  /// Marks a particle that has become Eulerian and all of its body within `reach` [m] in the reference configuration.
  void lose(ParticleSet const& set, Index slot, double reach);

 private:
  std::vector<std::uint8_t> lost_;
  std::int64_t count_ = 0;
  std::map<int, std::unique_ptr<CellGrid>> places_;  ///< of a body's particles, built at its first loss
};

}  // namespace piola::adaptle
