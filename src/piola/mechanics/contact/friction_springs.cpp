// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/friction_springs.hpp"
#include "piola/base/contracts.hpp"
#include "piola/mechanics/contact/state_vector.hpp"
#include <algorithm>
#include <cmath>
#include <utility>

namespace piola::contact {

FrictionSprings::FrictionSprings(ContactModel const& model)
    : history_(model.definition.has_friction() ? at(model.points.count()) : 0) {}

void FrictionSprings::begin() {
  std::swap(springs_, last_springs_);
  springs_.clear();
  std::fill(heat_.begin(), heat_.end(), 0.0);
}

void FrictionSprings::add_slip(ContactModel const& model, Index point, double slid, double heat) {
  history_[at(point)].slid += slid;
  history_[at(point)].heat += heat;
  if (!heat_.empty()) heat_[at(model.points[point].host)] += heat;
}

/// Advances the spring of a contact; a new one starts without stretch. frame: rotates with the point's surface.
FrictionSprings::FrictionForce FrictionSprings::update(NormalContact const& contact, FrictionLaw const& law,
                                                       Mat<3> const& frame, Slip const& slip, double dt,
                                                       ContactForces& forces) {
  StickState const key{contact.point, contact.with, {}, {}, 0};
  auto const last = std::lower_bound(last_springs_.begin(), last_springs_.end(), key);
  bool const known = last != last_springs_.end() && last->point == contact.point && last->with == contact.with;
  Spring const before = known ? Spring{frame * last->stretch, last->force} : Spring{};
  auto const& [jump, n] = slip;
  FrictionState const now =
      update_friction(known ? &before : nullptr, jump, n, contact.stiffness, law, contact.force, contact.area, dt);
  forces.add_friction(now.energy, now.work);
  springs_.push_back({contact.point, contact.with, inverse(frame) * now.spring.stretch, now.spring.force, now.energy});
  if (!known) return {now.spring.force, 0, 0};
  // The slip that the spring did not take up.
  Vec<3> const along = jump - dot(n, jump) * n;
  return {now.spring.force, now.work + last->energy - now.energy,
          std::sqrt(square_of(before.stretch + along - now.spring.stretch))};
}

/// Subtracts the mean motion of the planes at y [m] from the displacement `moved` of the point there. Stores the arms
/// of the planes for react().
FrictionSprings::Slip FrictionSprings::slip_over(ContactModel& model, NearPlanes const& planes, Vec<3> const& y,
                                                 Vec<3> const& moved) {
  SurfacePoints& points = model.points;
  Slip slip{moved, {}};
  arms_.clear();
  for (std::size_t s = 0; s < planes.points.size(); ++s) {
    Index const source = planes.points[s], host = points[source].host;
    Plane const& b = points.plane(source);
    Vec<3> const r = y - b.y;
    double const fraction = planes.weights[s] / planes.weight;
    arms_.emplace_back(fraction, fraction > 0 ? inverse(points.F(host)) * r : Vec<3>{});
    if (!(fraction > 0)) continue;
    Mat<3> const change = points.F(host) - points.last_F(host);
    slip.jump = slip.jump - fraction * (points.displacement(source) + change * arms_.back().second);
    slip.n = slip.n + fraction * b.n;
  }
  slip.n = (1 / std::sqrt(square_of(slip.n))) * slip.n;
  return slip;
}

/// Applies the reaction and half of the heat to the planes of slip_over().
void FrictionSprings::react(ContactModel const& model, NearPlanes const& planes, FrictionForce const& friction,
                            ContactForces& forces) {
  for (std::size_t k = 0; k < arms_.size(); ++k) {
    auto const& [fraction, arm] = arms_[k];
    if (!(fraction > 0)) continue;
    forces.add_load(planes.points[k], {-fraction * friction.force, {}, fraction * outer(friction.force, arm)});
    add_slip(model, planes.points[k], 0, 0.5 * fraction * friction.heat);
  }
}

void FrictionSprings::slide_on_body(ContactModel& model, NormalContact const& contact, NearPlanes const& planes,
                                    ContactForces& forces) {
  auto const k = static_cast<Index>(contact.point);
  SurfacePoints::Point const& point = model.points[k];
  FrictionLaw const& law = model.definition.pair(point.body, contact.with).friction;
  if (!law.any()) return;
  Vec<3> const& y = model.points.plane(k).y;
  Slip const slip = slip_over(model, planes, y, model.points.displacement(k));
  FrictionForce const friction = update(contact, law, model.points.F(point.host), slip, model.dt, forces);
  forces.add_load(k, {friction.force, {}, {}});
  add_slip(model, k, friction.slid, 0.5 * friction.heat);
  react(model, planes, friction, forces);
  forces.resultants().add_between(point.body, contact.with, y, friction.force);
}

void FrictionSprings::slide_on_rigid(ContactModel& model, NormalContact const& contact, std::size_t r, Vec<3> const& n,
                                     ContactForces& forces) {
  auto const k = static_cast<Index>(contact.point);
  SurfacePoints::Point const& point = model.points[k];
  FrictionLaw const& law = model.definition.with_rigid(point.body, r).friction;
  if (!law.any()) return;
  RigidSurface const& rigid = model.rigids[r];
  Vec<3> const& y = model.points.plane(k).y;
  Vec<3> const jump = model.points.displacement(k) - moved_from(model.last_poses[r], rigid, y);
  FrictionForce const friction = update(contact, law, model.points.F(point.host), {jump, n}, model.dt, forces);
  Vec<3> const& f = friction.force;
  forces.add_load(k, {f, {}, {}});
  add_slip(model, k, friction.slid, 0.5 * friction.heat);
  forces.resultants().add_on_rigid(r, -1.0 * f, -1.0 * cross(y - rigid.centre, f));
}

void FrictionSprings::slide_shape_point(ContactModel& model, NormalContact const& contact, Vec<3> const& y,
                                        NearPlanes const& planes, ContactForces& forces) {
  ShapePass const& pass = model.definition.shape_passes()[contact.with - model.definition.objects()];
  FrictionLaw const& law = model.definition.with_rigid(pass.body, pass.rigid).friction;
  if (!law.any()) return;
  RigidSurface const& rigid = model.rigids[pass.rigid];
  Slip const slip = slip_over(model, planes, y, moved_from(model.last_poses[pass.rigid], rigid, y));
  FrictionForce const friction = update(contact, law, rigid.turn, slip, model.dt, forces);
  forces.resultants().add_on_rigid(pass.rigid, friction.force, cross(y - rigid.centre, friction.force));
  react(model, planes, friction, forces);
}

void FrictionSprings::finish(ContactModel const& model) {
  std::sort(springs_.begin(), springs_.end());
  auto kept = springs_.begin();
  for (StickState const& last : last_springs_) {
    kept = std::lower_bound(kept, springs_.end(), last);
    bool const of_body = last.with < model.definition.objects();
    if (of_body && (kept == springs_.end() || last < *kept))
      add_slip(model, static_cast<Index>(last.point), 0, last.energy);
  }
}

void FrictionSprings::damp_chatter(ContactModel const& model, std::vector<double> const& fractions) {
  SurfacePoints const& points = model.points;
  PIOLA_EXPECTS(fractions.size() == points.surfaces().size());
  chatter_ = ChatterDamping(points.hosts(), points.surfaces(), fractions, points.hosts().dimension());
  if (damps_chatter()) heat_.resize(at(points.hosts().count()));
}

ChatterDamping const& FrictionSprings::chatter(ContactModel const& model, std::vector<Vec<3>> const& x,
                                               std::vector<Vec<3>> const& v) {
  PIOLA_EXPECTS(model.definition.has_friction());
  chatter_.evaluate(model.points.hosts(), {x, v, model.points.inverse_masses(), heat_, model.dt});
  return chatter_;
}

void FrictionSprings::save(std::vector<double>& all) const {
  put_some(
      all, history_.size(), [&](std::size_t k) { return history_[k].slid != 0 || history_[k].heat != 0; },
      [&](std::size_t k) {
        all.insert(all.end(), {history_[k].slid, history_[k].heat});
      });
  for (StickState const& s : springs_) {
    all.insert(all.end(), {static_cast<double>(s.point), static_cast<double>(s.with)});
    put(all, s.stretch);
    put(all, s.force);
    all.push_back(s.energy);
  }
}

void FrictionSprings::load(StateVector& from) {
  auto const next = [&] { return from.next(); };
  std::fill(heat_.begin(), heat_.end(), 0.0);
  std::fill(history_.begin(), history_.end(), SlipHistory{});
  for (auto n = from.count(); n > 0; --n) {
    auto const k = from.count();
    history_[k] = {next(), next()};
  }
  springs_.clear();
  while (from.any()) {
    StickState s{static_cast<std::int64_t>(next()), from.count(), {}, {}, 0};
    from.take(s.stretch);
    from.take(s.force);
    s.energy = next();
    springs_.push_back(s);
  }
}

}  // namespace piola::contact
