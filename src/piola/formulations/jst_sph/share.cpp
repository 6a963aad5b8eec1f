// SPDX-License-Identifier: Apache-2.0
// Ranks: every rank makes the whole body and then works on its share of the slots. What its particles read of others
// comes by messages. The slots of a particle are the same on all ranks, so nothing else of the body changes.
#include "piola/formulations/jst_sph/body.hpp"
#include "piola/parallel/own_slots.hpp"
#include "piola/parallel/ranks.hpp"
#include <algorithm>

namespace piola::jst_sph {

Range JstBody::own() const {
  return {std::min(state_.slots.first, order_.particles), std::min(state_.slots.last, order_.particles)};
}

void JstBody::share(int lanes) {
  if (!ranks::several()) return;
  state_.slots = share_of(order_.slots(), ranks::own(), ranks::count());
  halo_ = std::make_unique<HaloPlan>(order_.slots(), slots_read(lanes));
  state_.halo = halo_.get();
  lines_ = std::make_unique<SharedLines>(*set_, body_, order_, own());
  boundary_.share(state_.slots);
}

/// Where the particles of this rank find what they read of others: those themselves, or those that images copy.
std::vector<Index> JstBody::slots_read(int lanes) const {
  std::vector<bool> seen(static_cast<std::size_t>(order_.slots()));
  auto const add = [&](Index slot) { seen[static_cast<std::size_t>(slot)] = true; };
  for (Index i = own().first; i < own().last; ++i) {
    if (!state_.regular) {
      auto const& list = state_.list;
      for (auto k = list.begin[i]; k < list.begin[i + 1]; ++k) {
        Index const b = list.neighbour[k];
        add(b < order_.slots() ? b : images_.particles().source[static_cast<std::size_t>(b - order_.slots())]);
      }
      continue;
    }
    StencilTable const& table = state_.stencil;
    StencilPattern const& pattern = table.patterns[table.pattern_of[i / lanes]];
    for (auto const* run : {pattern.inner, pattern.outer})
      for (std::int32_t k = run[0]; k < run[1]; ++k) {
        StencilEntry const& entry = table.entries[k];
        if (entry.weights < 0 || table.weights[entry.weights + i % lanes] != 0) add(i + entry.delta);
      }
  }
  std::vector<Index> read;
  for (Index i = 0; i < order_.particles; ++i)
    if (seen[static_cast<std::size_t>(i)] && (i < own().first || i >= own().last)) read.push_back(i);
  return read;
}

/// What sweeps read at neighbours, field by field, as place_gathered() has laid it out; alpha and beta never change.
std::vector<JstBody::Told> JstBody::told() const {
  auto const& s = state_;
  bool const smoothed_J = options_.smoothed_volume(), stabilised = options_.biharmonic != Biharmonic::none;
  int const smoothed = stabilised ? D_ + (smoothed_J ? 1 : 0) : 0;
  int const before_A = options_.biharmonic == Biharmonic::adjoint ? smoothed + D_ + 1 : smoothed;
  std::vector<Told> const all{{s.u, 0,
                               D_ + (gathers_position() ? D_
                                     : smoothed_J       ? 1
                                                        : 0),
                               1},
                              {s.second, 0, smoothed, 1},
                              {s.second, before_A, D_ * D_, 1},
                              {s.ahead, 0, D_ + D_ * D_ + 1, 1},
                              {s.kernel_force, 0, D_, 1},
                              // Passes of the filter and of its adjoint read one buffer and write the other.
                              {s.filter_source[0], 0, 1, options_.filter_passes},
                              {s.filter_source[1], 0, 1, options_.filter_passes}};
  std::vector<Told> real;
  for (Told const& t : all)
    if (t.field.data != nullptr && t.count > 0) real.push_back(t);
  return real;
}

void JstBody::mark_halo() {
  for (Told const& t : told()) halo_->add(t.field, t.first, t.count);
}

Talk JstBody::talk() const {
  Talk talk;
  talk.reach = options_.kernel->support * spacing() *
               std::max(options_.gradient_support, is_wide() ? options_.laplacian_support : 0);
  double const* last = nullptr;
  for (Told const& t : told()) {
    if (t.field.data == last)
      talk.values.back() += t.count;  // two runs of one message
    else
      talk.values.insert(talk.values.end(), static_cast<std::size_t>(t.times), t.count);
    last = t.field.data;
  }
  int const stages = verlet() ? 1 : 2;
  bool const rigid_of_stages = !verlet() && state_.constants.without_rigid;
  // Sums of motion and of forces; work of supports and loads, wave speed, failures.
  talk.collectives = (verlet() ? 2 : stages * (rigid_of_stages ? 2 : 1)) + 3;
  return talk;
}

}  // namespace piola::jst_sph
