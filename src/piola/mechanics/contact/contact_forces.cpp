// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/contact_forces.hpp"
#include "piola/mechanics/contact/state_vector.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola::contact {

ContactForces::ContactForces(SurfacePoints const& points, std::size_t rigids)
    : loads_(at(points.count())),
      has_load_(loads_.size()),
      gap_(loads_.size()),
      normal_force_(loads_.size()),
      forces_(points.ids().size()),
      has_force_(forces_.size()),
      resultants_(points.surfaces().size(), rigids) {}

void ContactForces::clear() {
  for (Index const k : loaded_indices_) {
    forces_[at(k)] = {};
    has_force_[at(k)] = 0;
  }
  for (Index const k : loaded_points_) has_load_[at(k)] = 0;
  std::fill(normal_force_.begin(), normal_force_.end(), 0.0);
  std::fill(gap_.begin(), gap_.end(), std::numeric_limits<double>::infinity());
  loaded_indices_.clear();
  loaded_points_.clear();
  totals_ = {};
  energy_ = spring_energy_ = friction_work_ = {};
  resultants_.clear();
}

void ContactForces::add_load(Index point, PointLoad const& load) {
  PointLoad& sum = loads_[at(point)];
  if (has_load_[at(point)] == 0) {
    has_load_[at(point)] = 1;
    loaded_points_.push_back(point);
    sum = {};
  }
  sum.force = sum.force + load.force;
  sum.by_normal = sum.by_normal + load.by_normal;
  sum.on_gradient = sum.on_gradient + load.on_gradient;
}

void ContactForces::add_force(Index particle, Vec<3> const& f) {
  if (has_force_[at(particle)] == 0) {
    has_force_[at(particle)] = 1;
    loaded_indices_.push_back(particle);
    forces_[at(particle)] = {};
  }
  forces_[at(particle)] = forces_[at(particle)] + f;
}

void ContactForces::finish(SurfacePoints const& points) {
  totals_.energy = energy_.value();
  totals_.spring_energy = spring_energy_.value();
  totals_.friction_work = friction_work_.value();
  resultants_.finish();
  HostParticles const& hosts = points.hosts();
  std::sort(loaded_points_.begin(), loaded_points_.end());
  for (Index const k : loaded_points_) {
    SurfacePoints::Point const& p = points[k];
    normal_force_[at(k)] = -dot(loads_[at(k)].force, points.plane(k).n);
    Mat<3> const T = couple(p.S, p.N, points.F(p.host), loads_[at(k)]);
    Vec<3> own = loads_[at(k)].force;
    for (std::size_t j = hosts.first(p.host); j < hosts.last(p.host); ++j) {
      HostParticles::Neighbour const& b = hosts.neighbour(j);
      Vec<3> const f = T * b.g;
      add_force(b.at, -1.0 * f);
      own = own + f;
    }
    add_force(hosts.self(p.host), own);
  }
  std::sort(loaded_indices_.begin(), loaded_indices_.end());
}

void ContactForces::save(std::vector<double>& all) const {
  all.insert(all.end(),
             {totals_.energy, totals_.deepest, totals_.frequency2, totals_.spring_energy, totals_.friction_work,
              static_cast<double>(totals_.touched), static_cast<double>(loaded_indices_.size())});
  for (Index const k : loaded_indices_) {
    all.push_back(k);
    put(all, forces_[at(k)]);
  }
  resultants_.save(all);
  put_some(
      all, gap_.size(), [&](std::size_t k) { return std::isfinite(gap_[k]) || normal_force_[k] != 0; },
      [&](std::size_t k) {
        all.insert(all.end(), {gap_[k], normal_force_[k]});
      });
}

void ContactForces::load(StateVector& from) {
  auto const next = [&] { return from.next(); };
  totals_ = {next(), next(), next(), next(), next(), static_cast<std::int64_t>(next())};
  for (auto n = from.count(); n > 0; --n) {
    auto const k = static_cast<Index>(next());
    add_force(k, {});
    from.take(forces_[at(k)]);
  }
  resultants_.load(from);
  for (auto n = from.count(); n > 0; --n) {
    auto const k = from.count();
    gap_[k] = next();
    normal_force_[k] = next();
  }
}

}  // namespace piola::contact
