// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/late_rigid_contact.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <limits>
#include <utility>

namespace piola::contact {
namespace {

/// Stiffness of the layer between particles of a body and a rigid shape [Pa/m].
double stiffness_of(ContactModel const& model, std::size_t body, std::size_t rigid) {
  Surface const& surface = model.points.surfaces()[body];
  return penalty_stiffness(1, model.definition.with_rigid(body, rigid).factor, surface.modulus, surface.spacing);
}

}  // namespace

void LateRigidContact::set_particles(std::size_t body, std::vector<Index> const& at,
                                     std::vector<double> const& volumes) {
  PIOLA_EXPECTS(at.size() == volumes.size());
  for (std::size_t k = 0; k < at.size(); ++k) particles_.push_back({at[k], body, volumes[k]});
}

void LateRigidContact::add_targets(std::vector<char> const& marked) {
  late_.add(marked);
  targets_.clear();
  for (Particle const& particle : particles_)
    if (late_.has(particle.at)) targets_.push_back(particle);
  std::sort(targets_.begin(), targets_.end(), [](auto const& a, auto const& b) { return a.at < b.at; });
}

void LateRigidContact::set_masses(std::vector<double> const& masses) {
  if (any()) masses_ = masses;
}

void LateRigidContact::evaluate(ContactModel const& model, std::vector<Vec<3>> const& x, ContactForces& sums) {
  for (Index const k : loaded_indices_) forces_[at(k)] = {};
  loaded_indices_.clear();
  near_.clear();
  PairValues const inherited = std::exchange(inherited_, {});
  if (!any()) return;
  PIOLA_EXPECTS(masses_.size() == x.size());
  forces_.resize(x.size());
  for (Particle const& target : targets_)
    for (std::size_t r = 0; r < model.rigids.size(); ++r) {
      if (!model.definition.with_rigid(target.body, r).is_active) continue;
      double const spacing = model.points.surfaces()[target.body].spacing;
      Vec<3> const& y = x[at(target.at)];
      Distance const d = distance_from(model.rigids[r], y);
      double const gap = late_.pushing_gap(static_cast<Index>(r), target.at, d.value - 0.5 * spacing,
                                           first_gap(model, target, r, inherited));
      if (!(gap < near * spacing)) continue;
      near_.push_back({target, r, y, d.normal});
      sums.record_depth(std::max(0.5 - d.value / spacing, 0.0));
      push(model, near_.back(), gap, sums);
    }
  loaded_indices_.erase(std::unique(loaded_indices_.begin(), loaded_indices_.end()), loaded_indices_.end());
  late_.settle();
}

/// The gap by which a target pushes when it joins [m]: that with the energy that its surface stored.
double LateRigidContact::first_gap(ContactModel const& model, Particle const& target, std::size_t rigid,
                                   PairValues const& inherited) {
  auto const stored = inherited.find({target.at, static_cast<Index>(rigid)});
  if (stored == inherited.end()) return 0;
  double const spacing = model.points.surfaces()[target.body].spacing;
  return gap_of_layer(stored->second * spacing / target.volume, stiffness_of(model, target.body, rigid), 0.5 * spacing);
}

void LateRigidContact::push(ContactModel const& model, Near const& target, double gap, ContactForces& sums) {
  auto const& [index, body, volume] = target.particle;
  Surface const& surface = model.points.surfaces()[body];
  RigidSurface const& rigid = model.rigids[target.rigid];
  double const length = 0.5 * surface.spacing, area = volume / surface.spacing, inside = std::min(gap, 0.0);
  double const stiffness = stiffness_of(model, body, target.rigid);
  double const spring = frequency2(stiffness, area, inside, length, 1), omega2 = spring / masses_[at(index)];
  sums.record_frequency2(omega2);
  if (rigid.inverse_mass > 0) {
    double& of_points = sums.resultants().own_frequencies(target.rigid).of_points;
    of_points = std::max(of_points, omega2);
    sums.resultants().add_spring(target.rigid, spring * rigid.mobility(target.y, target.normal));
  }
  if (!(gap < 0)) return;
  Layer const psi = layer(gap, stiffness, length);
  Vec<3> const f = (-area * psi.slope) * target.normal;
  sums.add_contact(area * psi.energy);
  sums.resultants().add_on_rigid(target.rigid, -1.0 * f, -1.0 * cross(target.y - rigid.centre, f));
  forces_[at(index)] = forces_[at(index)] + f;
  loaded_indices_.push_back(index);
}

double LateRigidContact::contact_time_step(ContactModel const& model, std::vector<Vec<3>> const& v) const {
  double step = std::numeric_limits<double>::infinity();
  for (Near const& target : near_) {
    double const speed =
        -dot(v[at(target.particle.at)] - model.rigids[target.rigid].velocity_at(target.y), target.normal);
    double const spacing = model.points.surfaces()[target.particle.body].spacing;
    if (speed > 0) step = std::min(step, approach_in_a_step * spacing / speed);
  }
  return step;
}

}  // namespace piola::contact
