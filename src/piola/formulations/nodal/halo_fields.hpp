// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/halo_plan.hpp"
#include "piola/formulations/nodal/list_sums.hpp"
#include "piola/formulations/nodal/state.hpp"

namespace piola::nodal {

/// Adds the fields of ghost exchanges of a body: positions, what neighbours read of the stress, and heat.
template <int D>
void add_halo_fields(HaloPlan& halo, BodyState const& state) {
  constexpr int of_list = Records<D>::used, of_lattice = D + Quadratic<D>::second;
  halo.add(state.x, 0, D);
  halo.add(state.stress_for_neighbours, 0, D * (state.lattice.group != nullptr ? of_lattice : of_list));
  if (state.has.conducts) halo.add(state.heat, 0, HeatLayout::size);
}

}  // namespace piola::nodal
