// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/own_neighbours.hpp"
#include "piola/exec/set_up_loop.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace piola::contact {
namespace {

constexpr double longest_bond = 1.5, nearest_stranger = 4;  // in spacings

/// The particles of a body and the bonds between them.
class Bonds {
 public:
  Bonds(ParticleSet const& particles, Body const& body, double spacing)
      : X_(particles.X.begin() + body.first, particles.X.begin() + body.last),
        longest_(longest_bond * spacing),
        grid_(X_, longest_) {}

  /// All particles nearer than `reach` [m] to the particle k along bonds, k included, ascending.
  std::vector<Index> within(Index k, double reach) const {
    std::set<std::pair<double, Index>> ahead{{0.0, k}};
    std::map<Index, double> distance{{k, 0.0}};
    while (!ahead.empty()) {
      auto const [far, here] = *ahead.begin();
      ahead.erase(ahead.begin());
      grid_.visit(X_[static_cast<std::size_t>(here)], [&, far = far, here = here](Index j) {
        double const bond = length(here, j), there = far + bond;
        if (!(bond < longest_) || !(there < reach)) return;
        auto const [entry, fresh] = distance.try_emplace(j, there);
        if (!fresh && !(there < entry->second)) return;
        if (!fresh) ahead.erase({entry->second, j});
        entry->second = there;
        ahead.insert({there, j});
      });
    }
    std::vector<Index> all;
    for (auto const& [particle, d] : distance) all.push_back(particle);
    return all;
  }

 private:
  double length(Index a, Index b) const {
    auto const &p = X_[static_cast<std::size_t>(a)], &q = X_[static_cast<std::size_t>(b)];
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }
  std::vector<std::array<double, 3>> X_;
  double longest_;
  CellGrid grid_;
};

}  // namespace

OwnNeighbours::OwnNeighbours(ParticleSet const& particles, std::size_t b, Carriers const& carriers, double spacing) {
  Body const& body = particles.bodies[b];
  Bonds const bonds(particles, body, spacing);
  std::map<Index, Index> carrier_of;  // by particle of the body
  for (Index k = 0; k < carriers.count(); ++k) {
    auto const id = carriers.ids()[static_cast<std::size_t>(carriers.self(k))];
    if (id < body.first || id >= body.last) continue;
    if (carrier_of.empty()) first_ = k;
    carrier_of.emplace(static_cast<Index>(id - body.first), k);
  }
  std::vector<std::pair<Index, Index>> const known(carrier_of.begin(), carrier_of.end());
  near_.resize(known.size());
  exec_host::for_each_in_set_up(static_cast<Index>(known.size()), [&](Index n) {
    auto const& [particle, carrier] = known[static_cast<std::size_t>(n)];
    auto& near = near_[static_cast<std::size_t>(carrier - first_)];
    for (Index const other : bonds.within(particle, nearest_stranger * spacing))
      if (auto const found = carrier_of.find(other); found != carrier_of.end()) near.push_back(found->second);
    std::sort(near.begin(), near.end());
  });
}

bool OwnNeighbours::hold(Index carrier, Index other) const {
  auto const& near = near_[static_cast<std::size_t>(carrier - first_)];
  return std::binary_search(near.begin(), near.end(), other);
}

}  // namespace piola::contact
