// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/exec/parallel.hpp"
#include "piola/formulations/lattice_lines.hpp"
#include "piola/formulations/observation.hpp"
#include "piola/parallel/halo_plan.hpp"
#include "piola/particles/ordering.hpp"
#include <memory>

namespace piola {

/// The lattice lines through the particles that a rank has of a body, for Observation::add_oscillation: neighbours of
/// other ranks tell their pressures.
class SharedLines {
 public:
  /// `set`, `order` are kept by reference. Collective.
  SharedLines(ParticleSet const& set, Body const& body, SlotOrder const& order, Range own);
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
  SlotOrder const* order_;
  Range own_;
  LatticeLines lines_;  ///< of slots, around own particles
  Field pressure_{"PressureSeen", "Pa", 1, Role::derived};
  std::unique_ptr<HaloPlan> halo_;
};

}  // namespace piola
