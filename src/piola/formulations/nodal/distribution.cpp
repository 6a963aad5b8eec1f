// SPDX-License-Identifier: Apache-2.0
// Distribution over ranks: each rank owns a range of slots, and stores data for these and for their ghosts, which are
// updated by messages. Slots of particles are numbered alike on all ranks, so the rest of the body is unchanged.
#include "piola/domain/communicator.hpp"
#include "piola/formulations/nodal/body.hpp"
#include "piola/formulations/nodal/halo_fields.hpp"
#include <algorithm>

namespace piola::nodal {

Range NodalBody::own() const {
  return {std::min(state_.slots.first, order_.particles), std::min(state_.slots.last, order_.particles)};
}

void NodalBody::share() {
  if (!comm::is_parallel()) return;
  halo_ = std::move(reference_.halo);
  if (!halo_) halo_ = std::make_unique<HaloPlan>(order_.slots(), slots_read());
  lines_ = std::make_unique<LatticeLineHalo>(*set_, body_, order_, own());
}

void NodalBody::mark_halo() {
  state_.halo = halo_.get();
  state_.told = halo_->received().data();
  state_.told_count = static_cast<Index>(halo_->received().size());
  with_dimension(D_, [&](auto dimension) { tell_sums<dimension>(*halo_, state_); });
}

/// The neighbours of local particles, with images replaced by their sources. Equal for sums over a lattice.
std::vector<Index> NodalBody::slots_read() const {
  std::vector<Index> read;
  for (Index i = own().first; i < own().last; ++i)
    for (auto k = reference_.begin[static_cast<std::size_t>(i)]; k < reference_.begin[static_cast<std::size_t>(i) + 1];
         ++k) {
      Index const b = reference_.neighbour[static_cast<std::size_t>(k)];
      read.push_back(b < order_.slots() ? b : images_.particles().source[static_cast<std::size_t>(b - order_.slots())]);
    }
  return read;
}

}  // namespace piola::nodal
