// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/scaling.hpp"
#include "piola/neighbours/halo_count.hpp"
#include "piola/parallel/halo_plan.hpp"
#include "piola/particles/ordering.hpp"
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace piola {
namespace {

/// Who has which particle of a body, as runs share them out.
struct Owned {
  std::vector<std::array<double, 3>> X;
  std::vector<int> owner;
};

Owned owned_of(ParticleSet const& particles, SlotOrder const& order, int ranks) {
  Owned owned;
  for (int r = 0; r < ranks; ++r) {
    Range const share = share_of(order.slots(), r, ranks);
    for (Index slot = share.first; slot < std::min(share.last, order.particles); ++slot) {
      owned.X.push_back(particles.X[static_cast<std::size_t>(order.id[static_cast<std::size_t>(slot)])]);
      owned.owner.push_back(r);
    }
  }
  return owned;
}

void add_body(Owned const& owned, Talk const& talk, std::vector<RankShare>& shares) {
  auto const ranks = static_cast<int>(shares.size());
  for (int const r : owned.owner) shares[static_cast<std::size_t>(r)].particles += 1;
  std::map<double, HaloCounts> halos;  // by reach
  for (auto const& message : talk.messages)
    for (auto const& told : message)
      if (halos.find(told.reach) == halos.end())
        halos[told.reach] = count_halos(owned.X, owned.owner, ranks, told.reach);
  if (halos.empty()) return;
  for (std::size_t r = 0; r < shares.size(); ++r) {
    for (auto const& [s, count] : halos.rbegin()->second[r]) shares[r].halo += count;
    for (auto const& message : talk.messages) {
      std::set<int> senders;
      for (auto const& told : message)
        for (auto const& [s, count] : halos[told.reach][r]) {
          shares[static_cast<std::size_t>(s)].bytes += talk.stages * told.numbers * 8 * static_cast<double>(count);
          senders.insert(s);
        }
      for (int const s : senders) shares[static_cast<std::size_t>(s)].messages += talk.stages;
    }
  }
}

/// The most that a rank takes: in set-up, or, of rank 0, while it writes.
double memory_of(RankShare const& share, Estimate const& cost, double all, int ranks, bool writes) {
  if (ranks == 1) return cost.memory;
  double const held = static_cast<double>(share.particles + share.halo) / all, everywhere = cost.memory_everywhere;
  double const in_set_up = cost.everywhere_in_set_up + held * (cost.memory_in_set_up - cost.everywhere_in_set_up);
  double const in_steps = everywhere + held * std::max(cost.memory_in_steps - everywhere, 0.0);
  return writes ? std::max(in_set_up, in_steps + cost.memory_of_first) : in_set_up;
}

}  // namespace

bool runs_on_ranks(Estimate const& cost) {
  return !cost.talk.empty() && std::all_of(cost.talk.begin(), cost.talk.end(), [](auto const& t) { return !!t; });
}

Scaling scale(ParticleSet const& particles, Estimate const& cost, int ranks, Network const& network) {
  Scaling s;
  s.shares.resize(static_cast<std::size_t>(ranks));
  s.collectives = 1;  // what rank 0 tells the others to do
  double heaviest = 0;
  for (std::size_t b = 0; b < particles.bodies.size(); ++b) {
    Talk const& talk = *cost.talk[b];
    add_body(owned_of(particles, talk.order(particles, particles.bodies[b], ranks), ranks), talk, s.shares);
    s.collectives += talk.collectives;
    s.to_all += ranks > 1 ? 8 * talk.to_all : 0;
  }
  double const all = static_cast<double>(particles.size());
  StepTimes& t = s.times;
  for (RankShare& share : s.shares) {
    heaviest = std::max(heaviest, static_cast<double>(share.particles) / all);
    share.memory = memory_of(share, cost, all, ranks, &share == s.shares.data());
    double const packing = 2 * network.packing * share.bytes / 8 / cost.threads;
    t.messages = std::max(t.messages, share.messages * network.latency + share.bytes / network.bandwidth + packing);
  }
  t.messages += s.to_all / network.bandwidth + 2 * network.packing * s.to_all / 8 / cost.threads;
  t.sweeps = heaviest * cost.step_work / cost.threads;
  t.rows = cost.rows_per_step * cost.row_work / cost.threads;
  double const alone = cost.step_work / cost.threads + t.rows;
  if (ranks > 1) {
    double const of_first = cost.row_work_of_first;
    t.rows = cost.rows_per_step * (of_first + heaviest * (cost.row_work - of_first)) / cost.threads;
    t.collectives = s.collectives * 2 * std::ceil(std::log2(ranks)) * network.latency;
    t.rows += cost.rows_per_step * cost.row_bytes / network.bandwidth;
  } else {
    t.messages = 0;
  }
  s.efficiency = alone / (ranks * t.total());
  return s;
}

int ranks_that_pay(ParticleSet const& particles, Estimate const& cost, int most, Network const& network) {
  constexpr double enough = 0.5;
  int paying = 1;
  for (int ranks = 2; ranks <= most; ranks *= 2) {
    if (scale(particles, cost, ranks, network).efficiency < enough) break;
    paying = ranks;
  }
  return paying;
}

}  // namespace piola
