// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/halo_plan.hpp"
#include "piola/formulations/common/lattice_line_halo.hpp"
#include <utility>

namespace piola {

/// Communication of a body that is distributed over ranks: its ghosts, and its lattice lines for observers.
struct BodyHalo {
  /// `set`, `body`, `order` are kept by reference. own: slots of the local particles. Collective.
  BodyHalo(HaloPlan of_ghosts, ParticleSet const& set, Body const& body, SlotOrder const& order, Range own)
      : plan(std::move(of_ghosts)), lines(set, body, order, own) {}

  HaloPlan plan;
  LatticeLineHalo lines;
};

}  // namespace piola
