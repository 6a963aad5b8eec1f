// SPDX-License-Identifier: Apache-2.0
// Distribution over ranks: each rank owns a range of slots, and stores data for these and for their ghosts, which are
// updated by messages. Slots of particles are numbered alike on all ranks, so the rest of the body is unchanged.
#include "piola/domain/communicator.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/formulations/jst_sph/body.hpp"
#include <algorithm>
#include <utility>

namespace piola::jst_sph {

Range JstBody::own() const {
  return {std::min(state_.slots.first, order_.particles), std::min(state_.slots.last, order_.particles)};
}

/// Assigns this rank its range of slots: later set-up covers these alone. Collective.
void JstBody::distribute(int lanes) {
  if (!comm::is_parallel()) return;
  state_.slots = even_range_of_rank(order_.slots(), comm::rank(), comm::size());
  HaloPlan ghosts(order_.slots(), slots_of_neighbours(lanes, false));
  ghosts.add_cutoff(slots_of_neighbours(lanes, true));
  halo_ = std::make_unique<BodyHalo>(std::move(ghosts), *set_, body_, order_, own());
  state_.halo = &halo_->plan;
  boundary_.distribute(state_.slots);
}

/// The neighbours of local particles, with images replaced by their sources. Within the gradient's support or, if
/// `far`, within the Laplacian's, which contains it.
std::vector<Index> JstBody::slots_of_neighbours(int lanes, bool far) const {
  std::vector<bool> seen(static_cast<std::size_t>(order_.slots()));
  auto const add = [&](Index slot) { seen[static_cast<std::size_t>(slot)] = true; };
  for (Index i = own().first; i < own().last; ++i) {
    if (!state_.regular) {
      auto const& list = state_.list;
      auto const last = far ? list.begin[i + 1] : list.begin[i] + list.inner[i];
      for (auto k = list.begin[i]; k < last; ++k) {
        Index const b = list.neighbour[k];
        add(b < order_.slots() ? b : images_.particles().source[static_cast<std::size_t>(b - order_.slots())]);
      }
      continue;
    }
    StencilTable const& table = state_.stencil;
    StencilPattern const& pattern = table.patterns[table.pattern_of[i / lanes]];
    for (auto const* run : {pattern.inner, pattern.outer})
      for (std::int32_t k = run[0]; (far || run == pattern.inner) && k < run[1]; ++k) {
        StencilEntry const& entry = table.entries[k];
        if (entry.weights < 0 || table.weights[entry.weights + i % lanes] != 0) add(i + entry.delta);
      }
  }
  std::vector<Index> read;
  for (Index i = 0; i < order_.particles; ++i)
    if (seen[static_cast<std::size_t>(i)] && (i < own().first || i >= own().last)) read.push_back(i);
  return read;
}

}  // namespace piola::jst_sph
