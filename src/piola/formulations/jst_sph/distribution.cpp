// SPDX-License-Identifier: Apache-2.0
// Distribution over ranks: each rank owns a range of slots, and stores data for these and for their ghosts, which are
// updated by messages. Slots of particles are numbered alike on all ranks, so the rest of the body is unchanged.
#include "piola/domain/communicator.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/formulations/jst_sph/body.hpp"
#include <algorithm>
#include <set>

namespace piola::jst_sph {

Range JstBody::own() const {
  return {std::min(state_.slots.first, order_.particles), std::min(state_.slots.last, order_.particles)};
}

void JstBody::share(int lanes) {
  if (!comm::is_parallel()) return;
  state_.slots = even_range_of_rank(order_.slots(), comm::rank(), comm::size());
  halo_ = std::make_unique<HaloPlan>(order_.slots(), slots_read(lanes, false));
  halo_->add_cutoff(slots_read(lanes, true));
  state_.halo = halo_.get();
  lines_ = std::make_unique<LatticeLineHalo>(*set_, body_, order_, own());
  boundary_.share(state_.slots);
}

/// The neighbours of local particles, with images replaced by their sources. Within the gradient's support or, if
/// `far`, within the Laplacian's, which contains it.
std::vector<Index> JstBody::slots_read(int lanes, bool far) const {
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

/// Ghost data of the sweeps, field by field in the layout of place_gathered(), by message; alpha and beta are constant.
/// Gradients read near neighbours alone; Laplacians and the filter also far ones.
std::vector<std::vector<JstBody::Told>> JstBody::told() const {
  auto const& s = state_;
  bool const smoothed_J = options_.smoothed_volume();
  int const smoothed = stabilised() ? D_ + (smoothed_J ? 1 : 0) : 0;
  int const before_A = options_.biharmonic == Biharmonic::adjoint ? smoothed + D_ + 1 : smoothed;
  int const beside_u = gathers_position() ? D_ : smoothed_J ? 1 : 0;
  std::vector<std::vector<Told>> messages{
      {{s.u, 0, D_ + beside_u, stabilised()}},
      {{s.second, 0, smoothed, true}, {s.second, before_A, D_ * D_, false}},
  };
  // Passes of the filter and of its adjoint read one buffer and write the other.
  for (int pass = 0; pass < 2 * filter_passes; ++pass) messages.push_back({{s.filter_source[pass % 2], 0, 1, true}});
  for (auto& parts : messages)
    std::erase_if(parts, [](Told const& t) { return t.field.data == nullptr || t.count == 0; });
  std::erase_if(messages, [](auto const& parts) { return parts.empty(); });
  return messages;
}

void JstBody::mark_halo() {
  std::set<std::pair<double const*, int>> marked;
  for (auto const& parts : told())
    for (Told const& t : parts)
      if (marked.emplace(t.field.data, t.first).second) halo_->add(t.field, t.first, t.count, t.far ? 1 : 0);
}

}  // namespace piola::jst_sph
