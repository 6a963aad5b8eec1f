// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/particle_order.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace piola::adaptle {

/// Marks the particles that have lost their surface contact: Eulerian ones, and those with an Eulerian particle among
/// their reference neighbours. Used where bodies have surface contact first. Replicated on all ranks.
class LostSurfaces {
 public:
  LostSurfaces() = default;
  explicit LostSurfaces(ParticleSet const& set) : lost_(set.X.size(), 0) {}
  bool used() const { return !lost_.empty(); }
  std::int64_t count() const { return count_; }
  /// By slot: 1 if lost; empty where no bodies have surface contact first.
  std::vector<std::uint8_t> const& by_slot() const { return lost_; }
  /// A particle has turned Eulerian: it and all of its body within `reach` [m] in the reference configuration lose
  /// their surface.
  void lose(ParticleSet const& set, ParticleOrder const& order, Index slot, double reach);

 private:
  std::vector<std::uint8_t> lost_;
  std::int64_t count_ = 0;
  std::map<int, std::unique_ptr<CellGrid>> places_;  ///< of a body's particles, made when the first one is lost
};

}  // namespace piola::adaptle
