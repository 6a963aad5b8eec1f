// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/halo_plan.hpp"
#include "piola/formulations/nodal/list_sums.hpp"
#include "piola/formulations/nodal/state.hpp"

namespace piola::nodal {

/// Adds the fields of ghost exchanges of a body: positions, and rows (Y_i, Z_i) of stress.
template <int D>
void add_halo_fields(HaloPlan& halo, BodyState const& state) {
  using R = Records<D>;
  halo.add(state.x, 0, D);
  halo.add(state.motion_for_neighbours, 0, 0);  // products of x; in a record only x changes
  if (state.lattice.present != nullptr)
    halo.add(state.stress_for_neighbours, 0, D * R::used);
  else
    for (int c = 0; c < D; ++c) halo.add(state.stress_for_neighbours, c * R::width, R::used);
}

}  // namespace piola::nodal
