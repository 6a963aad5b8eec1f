// SPDX-License-Identifier: Apache-2.0
// Ranks: every rank makes the whole body and then works on its share of the slots. What its particles read of others
// comes by messages. The slots of a particle are the same on all ranks, so nothing else of the body changes.
#include "piola/formulations/nodal/body.hpp"
#include "piola/formulations/nodal/list_sums.hpp"
#include "piola/formulations/nodal/quadratic.hpp"
#include "piola/parallel/own_slots.hpp"
#include "piola/parallel/ranks.hpp"
#include <algorithm>

namespace piola::nodal {
namespace {

/// Numbers in a coefficient vector that count, and those that it takes, as Records has them.
std::array<int, 2> row_of(int D) {
  auto const of = [](auto r) { return std::array<int, 2>{r.used, r.width}; };
  return D == 1 ? of(Records<1>{}) : D == 2 ? of(Records<2>{}) : of(Records<3>{});
}

}  // namespace

Range NodalBody::own() const {
  return {std::min(state_.slots.first, order_.particles), std::min(state_.slots.last, order_.particles)};
}

void NodalBody::share() {
  if (!ranks::several()) return;
  state_.slots = share_of(order_.slots(), ranks::own(), ranks::count());
  halo_ = std::make_unique<HaloPlan>(order_.slots(), slots_read());
  state_.halo = halo_.get();
  auto const [used, width] = row_of(D_);
  state_.told = halo_->received().data();
  state_.told_count = static_cast<Index>(halo_->received().size());
  halo_->add(state_.x, 0, D_);
  halo_->add(state_.first, 0, 0);  // products of x, and of a record only x changes
  if (reference_.lattice) {
    halo_->add(state_.second, 0, D_ * used);
  } else {
    for (int c = 0; c < D_; ++c) halo_->add(state_.second, c * width, used);
  }
  boundary_->share(state_.slots);
}

/// Of neighbours, those themselves or those that images copy. Sums over a lattice have the same neighbours.
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

Talk NodalBody::talk() const {
  Talk talk;
  double const reach = usual_reach * *std::max_element(body_.spacing.begin(), body_.spacing.begin() + D_);
  talk.messages = {{{reach, D_}}, {{reach, D_ * row_of(D_)[0]}}};
  // The first failure with the largest change of a strain; sums of the unrest in every fourth step of calm motion and
  // in all before the first measurement; and what is measured.
  talk.collectives = 1.9;
  talk.order = [](ParticleSet const& set, Body const& body, int) { return slot_order(set, body); };
  return talk;
}

void NodalBody::gather(FieldRef const& field, int components) const { gather_slots(field, own(), components); }

}  // namespace piola::nodal
