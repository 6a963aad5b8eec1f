// SPDX-License-Identifier: Apache-2.0
#include "piola/estimates/scaling.hpp"
#include "piola/domain/halo_cells.hpp"
#include "piola/domain/halo_plan.hpp"
#include "piola/neighbours/cell_list.hpp"
#include "piola/neighbours/estimate_halo.hpp"
#include "piola/particles/ordering.hpp"
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace piola {
namespace {

/// Owner of each particle of a body, by the partition of runs.
struct Owned {
  std::vector<std::array<double, 3>> X;
  std::vector<int> owner;
};

Owned owned_of(ParticleSet const& particles, SlotOrder const& order, int ranks) {
  Owned owned;
  for (int r = 0; r < ranks; ++r) {
    Range const share = even_range_of_rank(order.slots(), r, ranks);
    for (Index slot = share.first; slot < std::min(share.last, order.particles); ++slot) {
      owned.X.push_back(particles.X[static_cast<std::size_t>(order.id[static_cast<std::size_t>(slot)])]);
      owned.owner.push_back(r);
    }
  }
  return owned;
}

void add_body(Owned const& owned, CommPattern const& talk, std::vector<RankLoad>& shares) {
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

/// Bodies with common cells.
struct BinnedParticles {
  Owned all;
  std::vector<Index> body;                ///< of each particle
  std::vector<std::uint8_t> is_eulerian;  ///< whether it does
  double cell = 0;
  bool touching = false;
};

BinnedParticles in_cells(Estimate const& cost, std::vector<Owned> const& bodies, std::size_t group) {
  BinnedParticles g;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    auto const& near = cost.talk[b]->near;
    if (!near || near->group != group) continue;
    std::size_t const n = bodies[b].owner.size();
    g.cell = std::max(g.cell, near->cell);
    g.touching = g.touching || near->touching;
    g.all.X.insert(g.all.X.end(), bodies[b].X.begin(), bodies[b].X.end());
    g.all.owner.insert(g.all.owner.end(), bodies[b].owner.begin(), bodies[b].owner.end());
    g.body.insert(g.body.end(), n, static_cast<Index>(b));
    bool const each = near->is_eulerian.size() == n;
    bool const any = std::find(near->is_eulerian.begin(), near->is_eulerian.end(), 1) != near->is_eulerian.end();
    for (std::size_t k = 0; k < n; ++k) g.is_eulerian.push_back(each ? near->is_eulerian[k] : any ? 1 : 0);
  }
  return g;
}

/// Adds the spatial halo to the model: two collectives for the occupied cells, one message of counts per pair of
/// adjacent ranks, then the given messages per ghost particle.
void add_near(int dimension, std::vector<CommPattern::SpatialHalo::Numbers> const& messages, BinnedParticles const& g,
              Scaling& s) {
  auto const n = static_cast<Index>(g.body.size());
  CellList grid;
  grid.find_cells(g.all.X[0].data(), 3, n, dimension, g.cell, g.all.X[0]);
  std::map<std::pair<Index, int>, HaloCells::Cell> cells;  // by cell and rank
  for (std::size_t k = 0; k < g.body.size(); ++k) {
    auto const i = static_cast<Index>(k);
    Index const key = grid.keys()[i];
    cells.try_emplace({key, g.all.owner[k]}, HaloCells::Cell{key, g.body[k]})
        .first->second.add(g.body[k], g.is_eulerian[k] != 0, grid.within(key, i));
  }
  HaloCells marks;
  marks.start(grid.shape(), dimension);
  for (auto const& [place, cell] : cells) marks.add(cell, place.second);
  marks.finish(g.touching);
  s.collectives += 2;
  s.replicated_values += static_cast<double>(s.shares.size() * sizeof(double) + cells.size() * sizeof(HaloCells::Cell));
  std::map<std::pair<Index, int>, std::vector<HaloCells::Reader>> readers;
  std::set<std::pair<int, int>> meet;
  for (auto const& [place, cell] : cells) {
    auto const& those = readers[place] = marks.readers(place.first, place.second);
    for (HaloCells::Reader const& reader : those) meet.insert({place.second, reader.rank});
  }
  std::vector<std::set<std::pair<int, int>>> pairs(messages.size());
  double const reach = grid.search_radius_in_cells();
  for (std::size_t k = 0; k < g.body.size(); ++k) {
    Index const key = grid.keys()[k];
    int const from = g.all.owner[k];
    int told = from;
    std::array<double, 3> const place = grid.where(static_cast<Index>(k));
    for (HaloCells::Reader const& reader : readers[{key, from}]) {
      if (reader.rank == told) continue;
      if (reader.box.bounds(grid.corner(reader.cell)).square_from(place) > reach * reach) continue;
      told = reader.rank;
      s.shares[static_cast<std::size_t>(told)].near += 1;
      std::uint8_t const kinds = marks.told(key);
      for (std::size_t m = 0; m < messages.size(); ++m) {
        int const numbers = messages[m].any + ((kinds & HaloCells::flow) != 0 ? messages[m].flow : 0) +
                            ((kinds & HaloCells::touch) != 0 ? messages[m].touch : 0);
        s.shares[static_cast<std::size_t>(from)].bytes += 8 * numbers;
        if (numbers > 0) pairs[m].insert({from, told});
      }
    }
  }
  for (auto const& [from, to] : meet) s.shares[static_cast<std::size_t>(from)].bytes += 8;
  pairs.push_back(std::move(meet));
  for (auto const& of_message : pairs)
    for (auto const& [from, to] : of_message) s.shares[static_cast<std::size_t>(from)].messages += 1;
}

/// As above for all groups of bodies with common cells.
void add_near(int dimension, Estimate const& cost, std::vector<Owned> const& bodies, Scaling& s) {
  std::set<std::size_t> seen;
  for (auto const& talk : cost.talk) {
    if (!talk->near || !seen.insert(talk->near->group).second) continue;
    BinnedParticles const g = in_cells(cost, bodies, talk->near->group);
    if (!g.touching && std::find(g.is_eulerian.begin(), g.is_eulerian.end(), 1) == g.is_eulerian.end()) continue;
    add_near(dimension, talk->near->messages, g, s);
  }
}

/// The most that a rank takes: in set-up, or, of rank 0, while it writes.
double memory_of(RankLoad const& share, Estimate const& cost, double all, int ranks, bool writes) {
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
  s.collectives = 1;  // command of rank 0
  double heaviest = 0;
  std::vector<Owned> owned;
  for (std::size_t b = 0; b < particles.bodies.size(); ++b) {
    CommPattern const& talk = *cost.talk[b];
    owned.push_back(owned_of(particles, talk.order(particles, particles.bodies[b], ranks), ranks));
    add_body(owned.back(), talk, s.shares);
    s.collectives += talk.collectives;
    s.replicated_values += ranks > 1 ? 8 * talk.replicated_values : 0;
  }
  if (ranks > 1) add_near(particles.dimension, cost, owned, s);
  double const all = static_cast<double>(particles.size());
  StepTimes& t = s.times;
  for (RankLoad& share : s.shares) {
    heaviest = std::max(heaviest, static_cast<double>(share.particles) / all);
    share.memory = memory_of(share, cost, all, ranks, &share == s.shares.data());
    double const packing = 2 * network.packing * share.bytes / 8 / cost.threads;
    t.messages = std::max(t.messages, share.messages * network.latency + share.bytes / network.bandwidth + packing);
  }
  t.messages += s.replicated_values / network.bandwidth + 2 * network.packing * s.replicated_values / 8 / cost.threads;
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

int max_efficient_ranks(ParticleSet const& particles, Estimate const& cost, int most, Network const& network) {
  constexpr double enough = 0.5;
  int paying = 1;
  for (int ranks = 2; ranks <= most; ranks *= 2) {
    if (scale(particles, cost, ranks, network).efficiency < enough) break;
    paying = ranks;
  }
  return paying;
}

}  // namespace piola
