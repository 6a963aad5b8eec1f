// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/self_contact_exclusions.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include "piola/neighbours/line_of_sight.hpp"
#include "piola/particles/body_range.hpp"
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace piola::contact {
namespace {

constexpr double longest_bond = 1.5, nearest_stranger = 4;  // in spacings

/// The bonds between the particles of a body.
class Bonds {
 public:
  Bonds(ParticleSet const& particles, Body const& body, double spacing)
      : bonds_(static_cast<std::size_t>(body.last - body.first)) {
    std::vector<std::array<double, 3>> const X(particles.X.begin() + body.first, particles.X.begin() + body.last);
    double const longest = longest_bond * spacing;
    CellGrid const grid(X, longest);
    LineOfSight const line(body.outline.distance, spacing);
    exec_host::parallel_for(static_cast<Index>(X.size()), [&](Index k) {
      auto const& here = X[static_cast<std::size_t>(k)];
      grid.visit(here, [&](Index j) {
        auto const& there = X[static_cast<std::size_t>(j)];
        double const length = std::hypot(here[0] - there[0], here[1] - there[1], here[2] - there[2]);
        if (j != k && length < longest && !line.is_blocked(here, there))
          bonds_[static_cast<std::size_t>(k)].push_back({length, j});
      });
    });
  }
  std::size_t count() const { return bonds_.size(); }

  /// Calls found(j) for all particles nearer than `reach` [m] to the particle k along bonds, k included, by distance.
  /// `distance` has one entry for each particle, infinite before and after.
  template <class F>
  void within(Index k, double reach, std::vector<double>& distance, F const& found) const {
    using Far = std::pair<double, Index>;
    std::priority_queue<Far, std::vector<Far>, std::greater<>> ahead;
    std::vector<Index> seen{k};
    distance[static_cast<std::size_t>(k)] = 0;
    for (ahead.push({0, k}); !ahead.empty();) {
      auto const [far, here] = ahead.top();
      ahead.pop();
      if (far > distance[static_cast<std::size_t>(here)]) continue;  // found nearer since
      found(here);
      for (auto const& [length, j] : bonds_[static_cast<std::size_t>(here)]) {
        double const there = far + length;
        double& known = distance[static_cast<std::size_t>(j)];
        if (!(there < reach) || !(there < known)) continue;
        known = there;
        seen.push_back(j);
        ahead.push({there, j});
      }
    }
    for (Index const j : seen) distance[static_cast<std::size_t>(j)] = std::numeric_limits<double>::infinity();
  }

 private:
  std::vector<std::vector<std::pair<double, Index>>> bonds_;  ///< length [m], particle
};

}  // namespace

SelfContactExclusions::SelfContactExclusions(ParticleSet const& particles, std::size_t b, HostParticles const& hosts,
                                             double spacing) {
  PIOLA_EXPECTS(b < particles.bodies.size() && is_range_in(particles.bodies[b], particles));
  Body const& body = particles.bodies[b];
  Bonds const bonds(particles, body, spacing);
  constexpr Index none = -1;
  std::vector<Index> host_of(bonds.count(), none), particle_of;  // particles count from the body's first
  for (Index k = 0; k < hosts.count(); ++k) {
    auto const id = hosts.ids()[static_cast<std::size_t>(hosts.self(k))];
    if (id < body.first || id >= body.last) continue;
    if (particle_of.empty()) first_ = k;
    particle_of.push_back(static_cast<Index>(id - body.first));
    host_of[static_cast<std::size_t>(id - body.first)] = k;
  }
  near_.resize(particle_of.size());
  constexpr Index parts = 64;
  exec_host::parallel_for_chunks(parts, static_cast<Index>(near_.size()), [&](Index part) {
    std::vector<double> distance(bonds.count(), std::numeric_limits<double>::infinity());
    for (auto n = static_cast<std::size_t>(part); n < near_.size(); n += parts) {
      bonds.within(particle_of[n], nearest_stranger * spacing, distance, [&](Index other) {
        if (Index const k = host_of[static_cast<std::size_t>(other)]; k != none) near_[n].push_back(k);
      });
      std::sort(near_[n].begin(), near_[n].end());
    }
  });
}

bool SelfContactExclusions::hold(Index host, Index other) const {
  auto const& near = near_[static_cast<std::size_t>(host - first_)];
  return std::binary_search(near.begin(), near.end(), other);
}

}  // namespace piola::contact
