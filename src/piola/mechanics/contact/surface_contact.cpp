// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/surface_contact.hpp"
#include "piola/base/contracts.hpp"
#include "piola/mechanics/contact/state_vector.hpp"
#include <algorithm>
#include <utility>

namespace piola::contact {

SurfaceContactSystem::SurfaceContactSystem(ParticleSet const& particles, std::vector<Surface> surfaces,
                                           std::vector<RigidSurface> rigids, PairSettings settings)
    : model_(particles, std::move(surfaces), std::move(rigids), std::move(settings)),
      skin_(model_.points.surfaces()),
      shape_points_(model_.points.surfaces().size()),
      state_(model_) {}

void SurfaceContactSystem::exclude_pair(std::size_t body, std::size_t point, std::size_t other, bool out) {
  model_.definition.exclude(model_.points.number_of(body, point), other, out);
  skin_.invalidate();
}

void SurfaceContactSystem::drop(std::vector<char> const& lost) {
  if (lost.empty()) return;
  PIOLA_EXPECTS(lost.size() == ids().size());
  for (Index k = 0; k < model_.points.count(); ++k) {
    if (lost[at(model_.points.particle(k))] == 0 || model_.definition.is_removed(k)) continue;
    for (std::size_t r = 0; r < model_.rigids.size() && !model_.points[k].image; ++r)
      if (model_.tests(k, r)) dropped_.emplace_back(k, r);
    model_.definition.remove(k);
  }
  skin_.invalidate();
  drops_ = true;
}

double SurfaceContactSystem::stored_at(std::size_t body, std::size_t point, std::size_t other) const {
  PIOLA_EXPECTS(other < model_.definition.objects());
  Index const k = model_.points.number_of(body, point);
  std::size_t const bodies = model_.points.surfaces().size();
  return other < bodies ? bodies_.energy_of(model_, k, other) : rigids_.energy_of(model_, k, other - bodies);
}

void SurfaceContactSystem::make_lists(std::vector<Vec<3>> const& x) {
  SurfacePoints& points = model_.points;
  points.activate(std::vector<char>(at(points.count()), 1));
  points.place(x);
  std::vector<std::vector<Index>> of_body(points.surfaces().size());
  for (Index k = 0; k < points.count(); ++k)
    if (!model_.definition.is_removed(k)) of_body[points[k].body].push_back(k);
  bodies_.search(model_, of_body, skin_.thickness());
  rigids_.search(model_, skin_.thickness());
  shape_points_.search(model_, of_body, skin_.thickness());

  std::vector<char> active(at(points.count()), 0);
  bodies_.mark(active);
  rigids_.mark(active);
  shape_points_.mark(active);
  points.activate(active);
  skin_.set(model_, x);
}

void SurfaceContactSystem::start(std::vector<Vec<3>> const& x) {
  PIOLA_EXPECTS(x.size() >= ids().size());
  model_.set_last(x);
  evaluate(x, 0);
}

void SurfaceContactSystem::evaluate(std::vector<Vec<3>> const& x, double dt) {
  PIOLA_EXPECTS(x.size() >= ids().size());
  model_.points.advance();
  if (std::exchange(drops_, false)) {
    model_.points.place(x);
    bodies_.carry_energies(model_);
    for (auto const& [k, r] : std::exchange(dropped_, {}))
      late_rigids_.inherit(model_.points.particle(k), r, rigids_.energy_of_any(model_, k, r));
  }
  if (!skin_.is_valid(model_, x)) make_lists(x);
  model_.dt = dt;
  state_.friction.begin();
  state_.passages.begin();
  evaluate_forces(x);
  state_.passages.count(model_);
  state_.friction.finish(model_);
  model_.set_last(x);
}

void SurfaceContactSystem::evaluate_forces(std::vector<Vec<3>> const& x) {
  state_.forces.clear();
  if (!model_.points.any_active() && !late_rigids_.any()) return;
  late_rigids_.evaluate(model_, x, state_.forces);
  model_.points.place(x);
  bodies_.evaluate(model_, state_);
  rigids_.evaluate(model_, x, state_);
  shape_points_.evaluate(model_, state_);
  state_.forces.finish(model_.points);
}

std::vector<double> SurfaceContactSystem::state() const {
  std::vector<double> all;
  rigids_.save(all);
  state_.passages.save(all);
  state_.forces.save(all);
  state_.friction.save(all);
  return all;
}

/// Restores the state after an evaluation at x.
void SurfaceContactSystem::restore(std::vector<Vec<3>> const& x, std::vector<double> const& state) {
  PIOLA_EXPECTS(x.size() >= ids().size());
  StateVector from(state);
  rigids_.load(from);
  state_.passages.load(from);
  make_lists(x);
  model_.points.place(x);
  shape_points_.find_gaps(model_);
  model_.set_last(x);
  late_rigids_.evaluate(model_, x, state_.forces);
  state_.forces.clear();
  state_.forces.load(from);
  state_.friction.load(from);
  drops_ = false;
  dropped_.clear();
}

std::vector<SurfaceContactSystem::ParticleContactState> SurfaceContactSystem::at_particles() const {
  struct Areas {
    double pushed = 0, all = 0;
  };
  SurfacePoints const& points = model_.points;
  ContactForces const& forces = state_.forces;
  std::vector<ParticleContactState> all(at(hosts().count()));
  std::vector<Areas> areas(all.size());
  for (Index k = 0; k < points.count(); ++k) {
    SurfacePoints::Point const& point = points[k];
    ParticleContactState& sum = all[at(point.host)];
    Areas& area = areas[at(point.host)];
    double const farthest = near * points.surface_of(k).spacing, force = forces.normal_force(k);
    if (!(area.all > 0)) sum = {ids()[at(points.particle(k))], 0, farthest, 0, 0};
    area.all += point.area;
    sum.gap = std::min(sum.gap, forces.gap(k));
    sum.pressure += force;
    if (force > 0 || force < 0) area.pushed += point.area;
    if (!state_.friction.has_history()) continue;
    FrictionSprings::SlipHistory const& history = state_.friction.history(k);
    sum.slid = std::max(sum.slid, history.slid);
    sum.heat += history.heat;
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (areas[k].pushed > 0) all[k].pressure /= areas[k].pushed;
    all[k].heat /= areas[k].all;
  }
  return all;
}

double SurfaceContactSystem::contact_time_step(std::vector<Vec<3>> const& v) const {
  PIOLA_EXPECTS(v.size() >= ids().size());
  return std::min({shape_points_.contact_time_step(model_, v), crossing_time_step(model_, v),
                   bodies_.contact_time_step(model_, v), rigids_.contact_time_step(model_, v),
                   late_rigids_.contact_time_step(model_, v)});
}

std::size_t SurfaceContactSystem::bytes() const {
  return model_.points.bytes() + at(model_.points.count()) * sizeof(PointLoad) + bodies_.bytes() +
         shape_points_.bytes();
}

}  // namespace piola::contact
