// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/system.hpp"
#include <algorithm>
#include <cmath>
#include <utility>

namespace piola::contact {

Mat<3> const& System::last_F(Index carrier) {
  if (knows_last_F_[at(carrier)] == 0) {
    knows_last_F_[at(carrier)] = 1;
    last_F_[at(carrier)] = carriers_.F(carrier, last_x_);
  }
  return last_F_[at(carrier)];
}

/// How far a point has moved since the evaluation before [m].
Vec<3> System::moved(Index point) {
  Point const& p = points_[at(point)];
  return planes_[at(point)].y - last_x_[at(carriers_.self(p.carrier))] - last_F(p.carrier) * p.S;
}

/// Follows the spring of a point; a new contact starts without one.
Spring System::drag(Index point, std::size_t with, Vec<3> const& jump, Vec<3> const& n, double k, double bound) {
  Stuck const key{point, with, {}, {}};
  auto const last = std::lower_bound(last_stuck_.begin(), last_stuck_.end(), key);
  bool const known = last != last_stuck_.end() && last->point == point && last->with == with;
  Mat<3> const& F = F_[at(points_[at(point)].carrier)];
  Spring const spring = dragged(known ? F * last->stretch : Vec<3>{}, known ? jump : Vec<3>{}, n, k, bound);
  if (known) totals_.friction_work += friction_work(last->force, spring.force, jump);
  totals_.spring_energy += 0.5 * k * square_of(spring.stretch);
  stuck_.push_back({point, with, inverse(F) * spring.stretch, spring.force});
  return spring;
}

/// Friction of a target on the planes that it touches. The jump is zero for any rigid motion of all.
void System::rub(Run const& run, Gap const& gap, double normal_force, double stiffness) {
  if (!(setting_.friction > 0)) return;
  Plane const& a = planes_[at(run.target)];
  Vec<3> jump = moved(run.target), n;
  std::vector<std::pair<double, Vec<3>>> sources;  // share, F^-1 r
  for (std::size_t s = run.first; s < run.last; ++s) {
    Plane const& b = planes_[at(sources_[s])];
    Vec<3> const r = a.y - b.y;
    double const share = weight_of(run, sources_[s]) / gap.weight;
    Index const carrier = points_[at(sources_[s])].carrier;
    sources.emplace_back(share, share > 0 ? inverse(F_[at(carrier)]) * r : Vec<3>{});
    if (!(share > 0)) continue;
    Mat<3> const change = F_[at(carrier)] - last_F(carrier);
    jump = jump - share * (moved(sources_[s]) + change * sources.back().second);
    n = n + share * b.n;
  }
  n = (1 / std::sqrt(square_of(n))) * n;
  Spring const spring = drag(run.target, run.body, jump, n, stiffness, setting_.friction * normal_force);
  Vec<3> const& f = spring.force;
  add_load(run.target, {f, {}, {}});
  for (std::size_t k = 0; k < sources.size(); ++k) {
    auto const& [share, arm] = sources[k];
    if (share > 0) add_load(sources_[run.first + k], {-share * f, {}, share * outer(f, arm)});
  }
  add_between(run, f);
}

void System::rub_on_rigid(Index k, std::size_t r, Vec<3> const& n, double normal_force, double stiffness) {
  if (!(setting_.friction > 0)) return;
  Vec<3> const& y = planes_[at(k)].y;
  Vec<3> const jump = moved(k) - moved_from(last_pose_[r], rigids_[r], y);
  Vec<3> const f = drag(k, surfaces_.size() + r, jump, n, stiffness, setting_.friction * normal_force).force;
  add_load(k, {f, {}, {}});
  on_rigid_[r] = {on_rigid_[r].force - f, on_rigid_[r].moment - cross(y - rigids_[r].centre, f)};
}

}  // namespace piola::contact
