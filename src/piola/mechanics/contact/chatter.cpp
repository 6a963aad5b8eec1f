// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/chatter.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <cmath>

namespace piola::contact {
namespace {

/// Times c/dp: measured on cases/contact/incline, where less leaves a vibration that lowers friction near its angle.
constexpr double rate = 10;
/// Threshold relative to the cube of the trace: below it there is no inertia about one of the axes, to round-off.
constexpr double flat_inertia = 1e-9;

/// f(i) for all particles of a cluster.
template <class F>
void for_members(HostParticles const& hosts, Index host, F const& f) {
  f(at(hosts.self(host)));
  for (std::size_t j = hosts.first(host); j < hosts.last(host); ++j) f(at(hosts.neighbour(j).at));
}

}  // namespace

ChatterDamping::ChatterDamping(HostParticles const& hosts, std::vector<Surface> const& surfaces,
                               std::vector<double> const& fractions, int dimension)
    : impulses_(hosts.ids().size()), is_damped_(hosts.ids().size()) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  PIOLA_EXPECTS(fractions.size() == surfaces.size());
  std::vector<double> around(hosts.ids().size());
  for (Index k = 0; k < hosts.count(); ++k) for_members(hosts, k, [&](std::size_t i) { around[i] += 1; });
  std::vector<char> known(at(hosts.count()));
  for (std::size_t b = 0; b < surfaces.size(); ++b)
    for (std::size_t p = 0; p < surfaces[b].points.size(); ++p) {
      Index const host = hosts.of(b, p);
      if (!(fractions[b] > 0) || known[at(host)] != 0) continue;
      known[at(host)] = 1;
      double most = 1;
      for_members(hosts, host, [&](std::size_t i) { most = std::max(most, around[i]); });
      clusters_.push_back(
          {host, surfaces[b].modulus * std::pow(surfaces[b].spacing, dimension - 2), fractions[b], 1 / most});
    }
}

/// The rigid motion with the momenta of the cluster, and which part of the rest is taken away.
ChatterDamping::Motion ChatterDamping::motion_of(Cluster const& cluster, HostParticles const& hosts,
                                                 State const& now) const {
  auto const mass = [&](std::size_t i) { return 1 / now.inverse_masses[i]; };
  Motion motion;
  double sum = 0;
  for_members(hosts, cluster.host, [&](std::size_t i) {
    sum += mass(i);
    motion.centre = motion.centre + mass(i) * now.x[i];
    motion.velocity = motion.velocity + mass(i) * now.v[i];
  });
  motion.centre = (1 / sum) * motion.centre;
  motion.velocity = (1 / sum) * motion.velocity;
  Mat<3> spread;
  Vec<3> momentum;
  for_members(hosts, cluster.host, [&](std::size_t i) {
    Vec<3> const r = now.x[i] - motion.centre;
    spread = spread + mass(i) * outer(r, r);
    momentum = momentum + mass(i) * cross(r, now.v[i] - motion.velocity);
  });
  double const size = trace(spread);
  Mat<3> const inertia = size * identity<3>() - spread;
  if (!(determinant(inertia) > flat_inertia * size * size * size)) return {};
  motion.spin = inverse(inertia) * momentum;
  double energy = 0;  // twice that of the rest
  for_members(hosts, cluster.host, [&](std::size_t i) {
    Vec<3> const rest = now.v[i] - motion.velocity - cross(motion.spin, now.x[i] - motion.centre);
    energy += mass(i) * dot(rest, rest);
  });
  double const own = now.inverse_masses[at(hosts.self(cluster.host))];
  double const factor = cluster.weight * -std::expm1(-rate * std::sqrt(cluster.stiffness * own) * now.dt);
  // A factor takes at most itself times this energy.
  double const allowed = cluster.fraction * now.heat[at(cluster.host)];
  motion.factor = factor * energy > allowed ? allowed / energy : factor;
  return motion;
}

void ChatterDamping::evaluate(HostParticles const& hosts, State const& now) {
  PIOLA_EXPECTS(now.x.size() >= impulses_.size() && now.v.size() >= impulses_.size());
  PIOLA_EXPECTS(now.inverse_masses.size() >= impulses_.size());
  PIOLA_EXPECTS(clusters_.empty() || now.heat.size() == at(hosts.count()));
  for (Index const i : damped_) {
    impulses_[at(i)] = {};
    is_damped_[at(i)] = 0;
  }
  damped_.clear();
  sliding_.clear();
  for (std::size_t k = 0; k < clusters_.size(); ++k)
    if (now.heat[at(clusters_[k].host)] > 0) sliding_.push_back(static_cast<Index>(k));
  motions_.resize(sliding_.size());
  exec_host::parallel_for(static_cast<Index>(sliding_.size()),
                          [&](Index k) { motions_[at(k)] = motion_of(clusters_[at(sliding_[at(k)])], hosts, now); });
  for (std::size_t k = 0; k < sliding_.size(); ++k) {
    Motion const& motion = motions_[k];
    if (!(motion.factor > 0)) continue;
    for_members(hosts, clusters_[at(sliding_[k])].host, [&](std::size_t i) {
      if (is_damped_[i] == 0) damped_.push_back(static_cast<Index>(i));
      is_damped_[i] = 1;
      Vec<3> const rest = now.v[i] - motion.velocity - cross(motion.spin, now.x[i] - motion.centre);
      impulses_[i] = impulses_[i] - (motion.factor / now.inverse_masses[i]) * rest;
    });
  }
  std::sort(damped_.begin(), damped_.end());
}

}  // namespace piola::contact
