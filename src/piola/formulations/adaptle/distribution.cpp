// SPDX-License-Identifier: Apache-2.0
// Distribution over ranks: each rank owns a contiguous range of slots per body, which repartitioning may change; it
// stores fields of these and of their reference ghosts. Kernel type and deletion flag of all particles are replicated.
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/formulations/adaptle/particles.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include <algorithm>
#include <array>

namespace piola::adaptle {

/// Builds the data of the local particles.
void Particles::take(std::vector<Partition> cuts) {
  PIOLA_EXPECTS(cuts.size() == own_.size());
  std::fill(rigid_action_.begin(), rigid_action_.end(), 0);  // a part may have fewer blocks than the one before
  owned_ = ParticlePartition(cuts);
  for (std::size_t b = 0; b < own_.size(); ++b) own_[b] = cuts[b].own();
  set_reference();
  set_factors();
  choose_material();
  if (!comm::is_parallel()) return;
  lines_.clear();
  for (std::size_t b = 0; b < own_.size(); ++b) {
    Index const first = body_[b].first;
    lines_.push_back(std::make_unique<LatticeLineHalo>(
        set_, set_.bodies[b], LatticeLineHalo::Slots{nullptr, first, body_[b].last - first},
        Range{own_[b].first - first, own_[b].last - first}, cuts[b].from_zero()));
  }
  exchanges_ = std::make_unique<StepHaloExchanges>(system_, material_, std::move(cuts));
}

/// CPU time relative to a total-Lagrangian particle, from the cubes of `piola bench adaptle`. Deleted particles only
/// have their point passes; blended ones count for both kernel types.
double Particles::work_of(Index slot) const {
  constexpr double eulerian = 1.5, corrected = 3.5, points = 0.3;
  if (!(fields_.active.at(slot) > 0)) return points;
  double const phi = fields_.phi.at(slot);
  double const is_eulerian = system_.settings.corrected ? corrected : eulerian;
  return points + (phi < 1 ? 1 - points : 0) + (phi > 0 ? is_eulerian - points : 0);
}

/// Repartitions. The fields of a checkpoint suffice for the new owner of a particle, as in a resumed run.
void Particles::rebalance() {
  std::vector<Partition> const& now = owned_.cuts();
  std::vector<std::vector<double>> work(now.size());
  for (std::size_t b = 0; b < now.size(); ++b) {
    Range const body = now[b].whole();
    work[b].resize(static_cast<std::size_t>(exec::block_count(body)));
    for (Index i = body.first; i < body.last; ++i)
      work[b][static_cast<std::size_t>((i - body.first) / exec::block_size)] += work_of(i);
  }
  auto [cuts, longest] = balance_.plan(now, std::move(work));
  if (cuts == now || !balance_.pays(longest)) return;
  std::vector<Partition> const before = now;
  take(cuts);
  migrate(before, cuts);
  balance_.record_repartition();
}

Resultants Particles::actions() const {
  Resultants all = actions_;
  if (!action_sums_) return all;
  auto [dt, impulses, rigids] = *action_sums_;
  if (exchanges_) {
    comm::allreduce_sum(std::span(impulses));
    comm::allreduce_sum(std::span(rigids));
  }
  for (std::size_t s = 0; s < supports_.size(); ++s) all.supports[s].add(impulses[s].value());
  for (std::size_t l = 0; l < loads_.size(); ++l) all.loads[l].add(impulses[supports_.size() + l].value());
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    exec::ReproducibleSums<6> const& sum = rigids[k];
    all.rigids[k].add({{dt * sum.value(0), dt * sum.value(1), dt * sum.value(2)},
                       {dt * sum.value(3), dt * sum.value(4), dt * sum.value(5)}});
  }
  return all;
}

/// Migrates particles from the old partition to the new one. Sends the fields of a checkpoint from the old owner to the
/// new one, except the replicated fields phi and active.
void Particles::migrate(std::vector<Partition> const& from, std::vector<Partition> const& to) {
  PIOLA_EXPECTS(from.size() == to.size());
  std::vector<Field*> fields;
  each_saved(fields_, [&](Field& field) {
    if (&field != &fields_.phi && &field != &fields_.active) fields.push_back(&field);
  });
  // Calls f(value) for the values sent from one rank to another.
  auto const each = [&](int giver, int taker, auto const& f) {
    for (std::size_t b = 0; b < from.size(); ++b) {
      Range const had = from[b].of(giver), has = to[b].of(taker);
      for (Index i = std::max(had.first, has.first); i < std::min(had.last, has.last); ++i)
        for (Field* field : fields)
          for (int c = 0; c < field->components(); ++c) f(field->at(i, c));
    }
  };
  auto const count = static_cast<std::size_t>(comm::size());
  std::vector<std::vector<double>> given(count), taken(count);
  std::vector<comm::Message> sends, receives;
  for (int rank = 0; rank < comm::size(); ++rank) {
    if (rank == comm::rank()) continue;
    std::vector<double>&out = given[at(rank)], &in = taken[at(rank)];
    each(comm::rank(), rank, [&](double value) { out.push_back(value); });
    std::size_t numbers = 0;
    each(rank, comm::rank(), [&](double) { ++numbers; });
    in.resize(numbers);
    if (!out.empty()) sends.push_back({rank, out.data(), out.size()});
    if (!in.empty()) receives.push_back({rank, in.data(), in.size()});
  }
  comm::exchange(receives, sends);
  for (int rank = 0; rank < comm::size(); ++rank) {
    auto value = taken[at(rank)].begin();
    if (rank != comm::rank()) each(rank, comm::rank(), [&](double& here) { here = *value++; });
  }
}

/// Replicates the values of the failed particle for its error message.
void Particles::broadcast_failure() {
  Index const slot = failure_.index != FailureSlot::none ? failure_.index : 0;
  Range const own = own_[at(body_of_[at(slot)])];
  for (Field* field : {&fields_.x, &fields_.v, &fields_.rho, &fields_.damage, &fields_.plastic_strain})
    allgather_selected_slots(field->ref(), own, std::array{slot}, field->components());
}

double Particles::contact_mass(std::int64_t id) const {
  auto const slot = static_cast<Index>(id);
  bool const there = fields_.active.at(slot) > 0;
  return there ? body_[at(body_of_[at(slot)])].rho0 * set_.volume[static_cast<std::size_t>(id)] : 0;
}

void Particles::read_motion(std::span<std::int64_t const> ids, std::span<std::array<double, 3>> x,
                            std::span<std::array<double, 3>> v) const {
  PIOLA_EXPECTS(x.size() == ids.size() && v.size() == ids.size());
  std::vector<double> motion(6 * ids.size(), 0);
  for (std::size_t k = 0; k < ids.size(); ++k) {
    auto const slot = static_cast<Index>(ids[k]);
    if (!is_local(slot)) continue;
    std::ranges::copy(point_at(fields_.x.ref(), slot, 3), &motion[6 * k]);
    std::ranges::copy(point_at(fields_.v.ref(), slot, 3), &motion[6 * k + 3]);
  }
  if (exchanges_) comm::allreduce_or(motion);
  for (std::size_t k = 0; k < ids.size(); ++k) {
    std::copy_n(&motion[6 * k], 3, x[k].begin());
    std::copy_n(&motion[6 * k + 3], 3, v[k].begin());
  }
}

}  // namespace piola::adaptle
