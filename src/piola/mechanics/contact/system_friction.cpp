// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/mechanics/contact/surface_contact.hpp"
#include <algorithm>
#include <cmath>
#include <utility>

namespace piola::contact {

Mat<3> const& SurfaceContactSystem::last_F(Index host) {
  if (knows_last_F_[at(host)] == 0) {
    knows_last_F_[at(host)] = 1;
    last_F_[at(host)] = hosts_.F(host, last_x_);
  }
  return last_F_[at(host)];
}

/// How far a point has moved since the evaluation before [m].
Vec<3> SurfaceContactSystem::moved(Index point) {
  Point const& p = points_[at(point)];
  return planes_[at(point)].y - last_x_[at(hosts_.self(p.host))] - last_F(p.host) * p.S;
}

void SurfaceContactSystem::trace(Index point, double slid, double heat) {
  traces_[at(point)].slid += slid;
  traces_[at(point)].heat += heat;
  if (!heat_.empty()) heat_[at(points_[at(point)].host)] += heat;
}

void SurfaceContactSystem::damp_chatter(std::vector<double> const& shares) {
  PIOLA_EXPECTS(shares.size() == surfaces_.size());
  chatter_ = ChatterDamping(hosts_, surfaces_, shares, hosts_.dimension());
  if (damps_chatter()) heat_.resize(at(hosts_.count()));
}

ChatterDamping const& SurfaceContactSystem::chatter(std::vector<Vec<3>> const& x, std::vector<Vec<3>> const& v) {
  PIOLA_EXPECTS(has_friction_);
  chatter_.look(hosts_, {x, v, inverse_mass_, heat_, dt_});
  return chatter_;
}

/// Advances the spring of a point; a new contact starts without stretch. frame: rotates with the point's surface.
SurfaceContactSystem::FrictionForce SurfaceContactSystem::drag(NormalContact const& press, FrictionLaw const& law,
                                                               Mat<3> const& frame, Vec<3> const& jump,
                                                               Vec<3> const& n) {
  StickState const key{press.point, press.with, {}, {}, 0};
  auto const last = std::lower_bound(last_stuck_.begin(), last_stuck_.end(), key);
  bool const known = last != last_stuck_.end() && last->point == press.point && last->with == press.with;
  Spring const before = known ? Spring{frame * last->stretch, last->force} : Spring{};
  FrictionState const now =
      update_friction(known ? &before : nullptr, jump, n, press.stiffness, law, press.force, press.area, dt_);
  sums_.spring_energy += now.energy;
  sums_.friction_work += now.work;
  stuck_.push_back({press.point, press.with, inverse(frame) * now.spring.stretch, now.spring.force, now.energy});
  if (!known) return {now.spring.force, 0, 0};
  // The slip that the spring did not take up.
  Vec<3> const along = jump - dot(n, jump) * n;
  return {now.spring.force, now.work + last->energy - now.energy,
          std::sqrt(square_of(before.stretch + along - now.spring.stretch))};
}

/// Springs of contacts that have opened leave their energy as heat.
void SurfaceContactSystem::book_lost_springs() {
  auto kept = stuck_.begin();
  for (StickState const& last : last_stuck_) {
    kept = std::lower_bound(kept, stuck_.end(), last);
    bool const of_body = last.with < others();
    if (of_body && (kept == stuck_.end() || last < *kept)) trace(static_cast<Index>(last.point), 0, last.energy);
  }
}

/// Subtracts the mean motion of the planes at a target from its jump [m] and finds their mean unit normal. Stores the
/// weights of the planes for rub_back().
void SurfaceContactSystem::slide_over(std::size_t first, std::size_t last, double weight, Vec<3> const& y, Vec<3>& jump,
                                      Vec<3>& n) {
  rubbed_.clear();
  for (std::size_t s = first; s < last; ++s) {
    Plane const& b = planes_[at(sources_[s])];
    Vec<3> const r = y - b.y;
    double const share = weights_[s] / weight;
    Index const host = points_[at(sources_[s])].host;
    rubbed_.emplace_back(share, share > 0 ? inverse(F_[at(host)]) * r : Vec<3>{});
    if (!(share > 0)) continue;
    Mat<3> const change = F_[at(host)] - last_F(host);
    jump = jump - share * (moved(sources_[s]) + change * rubbed_.back().second);
    n = n + share * b.n;
  }
  n = (1 / std::sqrt(square_of(n))) * n;
}

/// The planes that were slid over take the reaction and their half of the heat.
void SurfaceContactSystem::rub_back(std::size_t first, FrictionForce const& rubbed) {
  for (std::size_t k = 0; k < rubbed_.size(); ++k) {
    auto const& [share, arm] = rubbed_[k];
    if (!(share > 0)) continue;
    add_load(sources_[first + k], {-share * rubbed.force, {}, share * outer(rubbed.force, arm)});
    trace(sources_[first + k], 0, 0.5 * share * rubbed.heat);
  }
}

/// Friction of a target on the planes that it touches. The jump is zero for any rigid motion of all.
void SurfaceContactSystem::apply_friction(Run const& run, Gap const& gap, NormalContact const& press) {
  FrictionLaw const& law = setting_[points_[at(run.target)].body][run.body].friction;
  if (!law.any()) return;
  Vec<3> jump = moved(run.target), n;
  slide_over(run.first, run.last, gap.weight, planes_[at(run.target)].y, jump, n);
  FrictionForce const rubbed = drag(press, law, F_[at(points_[at(run.target)].host)], jump, n);
  add_load(run.target, {rubbed.force, {}, {}});
  trace(run.target, rubbed.slid, 0.5 * rubbed.heat);
  rub_back(run.first, rubbed);
  add_between(run, rubbed.force);
}

void SurfaceContactSystem::rub_on_rigid(NormalContact const& press, std::size_t r, Vec<3> const& n) {
  auto const k = static_cast<Index>(press.point);
  FrictionLaw const& law = with_rigid(points_[at(k)].body, r).friction;
  if (!law.any()) return;
  Vec<3> const& y = planes_[at(k)].y;
  Vec<3> const jump = moved(k) - moved_from(last_pose_[r], rigids_[r], y);
  FrictionForce const rubbed = drag(press, law, F_[at(points_[at(k)].host)], jump, n);
  Vec<3> const& f = rubbed.force;
  add_load(k, {f, {}, {}});
  trace(k, rubbed.slid, 0.5 * rubbed.heat);
  sums_.resultant_on_rigid[r].add(-1.0 * f, -1.0 * cross(y - rigids_[r].centre, f));
}

}  // namespace piola::contact
