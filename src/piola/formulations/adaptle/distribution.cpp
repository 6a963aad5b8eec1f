// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/distribution.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include <algorithm>
#include <utility>

namespace piola::adaptle {
namespace {

/// CPU time relative to a total-Lagrangian particle, from the cubes of `piola bench adaptle`. Deleted particles only
/// have their point passes; blended ones count for both kernel types.
double work_of(ParticleData const& particles, Index slot) {
  constexpr double eulerian = 1.5, corrected = 3.5, points = 0.3;
  if (!(particles.fields().active.at(slot) > 0)) return points;
  double const phi = particles.fields().phi.at(slot);
  double const spatial = particles.system().settings.corrected ? corrected : eulerian;
  return points + (phi < 1 ? 1 - points : 0) + (phi > 0 ? spatial - points : 0);
}

}  // namespace

void Distribution::assign(std::vector<Partition> cuts, System& system) {
  PIOLA_EXPECTS(cuts.size() == at(system.bodies));
  partition_ = ParticlePartition(std::move(cuts));
  system.part = partition_.own().data();
}

void Distribution::connect(ParticleData const& particles, ReferenceLists const& neighbours) {
  if (!comm::is_parallel()) return;
  lines_.clear();
  ParticleSet const& set = particles.set();
  for (std::size_t b = 0; b < set.bodies.size(); ++b) {
    BodyConstants const& body = particles.bodies()[b];
    Range const own = partition_.own()[b];
    lines_.push_back(std::make_unique<LatticeLineHalo>(
        set, set.bodies[b], LatticeLineHalo::Slots{nullptr, body.first, body.last - body.first},
        Range{own.first - body.first, own.last - body.first}, partition_.cuts()[b].from_zero()));
  }
  exchanges_ = std::make_unique<StepHaloExchanges>(particles.system(), neighbours, partition_.cuts());
}

std::optional<std::vector<Partition>> Distribution::plan(ParticleData const& particles) {
  if (!exchanges_ || !balance_.due()) return std::nullopt;
  std::vector<Partition> const& now = partition_.cuts();
  std::vector<std::vector<double>> work(now.size());
  for (std::size_t b = 0; b < now.size(); ++b) {
    Range const body = now[b].whole();
    work[b].resize(at(exec::block_count(body)));
    for (Index i = body.first; i < body.last; ++i)
      work[b][at((i - body.first) / exec::block_size)] += work_of(particles, i);
  }
  auto [cuts, longest] = balance_.plan(now, std::move(work));
  if (cuts == now || !balance_.pays(longest)) return std::nullopt;
  return std::move(cuts);
}

void Distribution::migrate(ParticleData& particles, std::vector<Partition> const& from) {
  std::vector<Partition> const& to = partition_.cuts();
  PIOLA_EXPECTS(from.size() == to.size());
  std::vector<Field*> fields;
  particles.each_saved(particles.fields(), [&](Field& field) {
    if (&field != &particles.fields().phi && &field != &particles.fields().active) fields.push_back(&field);
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
  balance_.record_repartition();
}

}  // namespace piola::adaptle
