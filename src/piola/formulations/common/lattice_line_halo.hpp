// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/halo_plan.hpp"
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field.hpp"
#include "piola/formulations/common/diagnostics_sum.hpp"
#include "piola/formulations/common/lattice_lines.hpp"
#include "piola/particles/ordering.hpp"
#include <cstdint>
#include <memory>

namespace piola {

/// The lattice lines through the local particles of a body, for DiagnosticsSum::add_oscillation. Pressures of ghosts
/// are exchanged.
class LatticeLineHalo {
 public:
  /// `set`, `order` are kept by reference. Collective.
  LatticeLineHalo(ParticleSet const& set, Body const& body, SlotOrder const& order, Range own)
      : LatticeLineHalo(set, body, {order.id.data(), 0, order.particles}, own, Partition({0, order.slots()})) {}
  /// Maps slots to ids: by the array `id`, or consecutively from `first_id` if `id` is null.
  struct Slots {
    std::int64_t const* id;
    std::int64_t first_id;
    Index particles;
    std::int64_t of(Index slot) const { return id != nullptr ? id[slot] : first_id + slot; }
  };
  /// own: local slots; cut: the partition of all slots, from 0 on.
  LatticeLineHalo(ParticleSet const& set, Body const& body, Slots slots, Range own, Partition const& cut);
  LatticeLineHalo(LatticeLineHalo const&) = delete;
  LatticeLineHalo& operator=(LatticeLineHalo const&) = delete;

  /// Pressure of a local slot [Pa], to be set before add_oscillation().
  double& pressure(Index slot) { return pressure_.at(slot); }
  /// Exchanges ghost pressures and adds the second differences of the local particles. Collective.
  void add_oscillation(DiagnosticsSum& o);
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
