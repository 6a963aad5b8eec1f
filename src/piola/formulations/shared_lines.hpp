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

/// The lattice lines through the particles that a rank has of a body, for Observation::add_oscillation: neighbours of
/// other ranks tell their pressures.
class SharedLines {
 public:
  /// `set`, `order` are kept by reference. Collective.
  SharedLines(ParticleSet const& set, Body const& body, SlotOrder const& order, Range own)
      : SharedLines(set, body, {order.id.data(), 0, order.particles}, own, Shares({0, order.slots()})) {}
  /// Where particles stand: id of slot 0 and on, or, without ids, the first one, from which they go on.
  struct Slots {
    std::int64_t const* id;
    std::int64_t first_id;
    Index particles;
    std::int64_t of(Index slot) const { return id != nullptr ? id[slot] : first_id + slot; }
  };
  /// own: slots of particles of this rank; cut: who has which, from 0 on.
  SharedLines(ParticleSet const& set, Body const& body, Slots slots, Range own, Shares const& cut);
  SharedLines(SharedLines const&) = delete;
  SharedLines& operator=(SharedLines const&) = delete;

  /// To be filled for own slots.
  double& pressure(Index slot) { return pressure_.at(slot); }
  /// Collective.
  void add_oscillation(Observation& o);
  std::size_t bytes() const;

 private:
  LatticeLines::At const& at(Index slot) const;

  ParticleSet const* set_;
  Slots slots_;
  Range own_;
  LatticeLines lines_;  ///< of slots, around own particles
  Field pressure_{"PressureSeen", "Pa", 1, Role::derived};
  std::unique_ptr<HaloPlan> halo_;
};

}  // namespace piola
