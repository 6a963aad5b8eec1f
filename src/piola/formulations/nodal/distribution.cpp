// SPDX-License-Identifier: Apache-2.0
// Distribution over ranks: each rank owns a range of slots, and stores data for these and for their ghosts, which are
// updated by messages. Slots of particles are numbered alike on all ranks, so the rest of the body is unchanged.
#include "piola/domain/communicator.hpp"
#include "piola/formulations/nodal/body.hpp"
#include <algorithm>
#include <utility>

namespace piola::nodal {
namespace {

/// The neighbours of the particles in these slots, with images replaced by their sources. Equal for sums over a
/// lattice.
std::vector<Index> slots_of_neighbours(Reference const& reference, Range of) {
  std::vector<Index> read;
  for (auto i = static_cast<std::size_t>(of.first); i < static_cast<std::size_t>(of.last); ++i)
    for (auto k = reference.begin[i]; k < reference.begin[i + 1]; ++k)
      read.push_back(reference.owner(reference.neighbour[static_cast<std::size_t>(k)]));
  return read;
}

}  // namespace

Range NodalBody::own() const {
  return {std::min(state_.slots.first, order_.particles), std::min(state_.slots.last, order_.particles)};
}

/// Collective.
void NodalBody::distribute() {
  if (!comm::is_parallel()) return;
  HaloPlan ghosts =
      reference_.halo ? std::move(*reference_.halo) : HaloPlan(order_.slots(), slots_of_neighbours(reference_, own()));
  reference_.halo.reset();
  halo_ = std::make_unique<BodyHalo>(std::move(ghosts), *set_, body_, order_, own());
}

}  // namespace piola::nodal
