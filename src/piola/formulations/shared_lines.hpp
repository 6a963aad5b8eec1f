// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/exec/parallel.hpp"
#include "piola/formulations/observation.hpp"
#include "piola/parallel/halo_plan.hpp"
#include "piola/particles/ordering.hpp"
#include <array>
#include <vector>

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
  using At = std::array<int, 3>;
  static constexpr Index nobody = -1;
  At const& at(Index slot) const;
  bool is_in_box(At const& at) const;
  std::size_t index(At const& at) const;
  /// Who comes before and after a particle on the line along an axis; `nobody` for both if one is missing.
  std::array<Index, 2> neighbours(Index slot, std::size_t axis) const;

  ParticleSet const* set_;
  SlotOrder const* order_;
  Range own_;
  At first_{}, size_{};       ///< of a box in the lattice around own particles and their neighbours
  std::vector<Index> slots_;  ///< in it; where several particles share a place that of the last one
  Field pressure_{"PressureSeen", "Pa", 1, Role::derived};
  std::unique_ptr<HaloPlan> halo_;
};

}  // namespace piola
