// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/exec/parallel.hpp"
#include "piola/formulations/lattice_lines.hpp"
#include "piola/formulations/observation.hpp"
#include "piola/parallel/halo_plan.hpp"
#include "piola/particles/ordering.hpp"
#include <cstdint>
#include <memory>

namespace piola {

/// The lattice lines through the local particles of a body, for Observation::add_oscillation. Pressures of ghosts are
/// exchanged.
class SharedLines {
 public:
  /// `set`, `order` are kept by reference. Collective.
  SharedLines(ParticleSet const& set, Body const& body, SlotOrder const& order, Range own)
      : SharedLines(set, body, {order.id.data(), 0, order.particles}, own, Shares({0, order.slots()})) {}
  /// Maps slots to ids: by the array `id`, or consecutively from `first_id` if `id` is null.
  struct Slots {
    std::int64_t const* id;
    std::int64_t first_id;
    Index particles;
    std::int64_t of(Index slot) const { return id != nullptr ? id[slot] : first_id + slot; }
  };
  /// own: local slots; cut: the partition of all slots, from 0 on.
  SharedLines(ParticleSet const& set, Body const& body, Slots slots, Range own, Shares const& cut);
  SharedLines(SharedLines const&) = delete;
  SharedLines& operator=(SharedLines const&) = delete;

  /// Pressure of a local slot [Pa], to be set before add_oscillation().
  double& pressure(Index slot) { return pressure_.at(slot); }
  /// Exchanges ghost pressures and adds the second differences of the local particles. Collective.
  void add_oscillation(Observation& o);
  std::size_t bytes() const;

 private:
  LatticeLines::At const& at(Index slot) const;

  ParticleSet const* set_;
  Slots slots_;
  Range own_;
  LatticeLines lines_;  ///< slots of local particles and around them
  Field pressure_{"PressureSeen", "Pa", 1, Role::derived};
  std::unique_ptr<HaloPlan> halo_;
};

}  // namespace piola
