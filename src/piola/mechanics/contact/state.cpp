// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/mechanics/contact/state_vector.hpp"
#include "piola/mechanics/contact/surface_contact.hpp"
#include <algorithm>
#include <cmath>

namespace piola::contact {

namespace {

/// Puts how many of the first n things there are to put, and each.
template <class Holds, class Put>
void put_some(std::vector<double>& all, std::size_t n, Holds const& holds, Put const& put_one) {
  std::size_t const count = all.size();
  all.push_back(0);
  for (std::size_t k = 0; k < n; ++k) {
    if (!holds(k)) continue;
    all[count] += 1;
    all.push_back(static_cast<double>(k));
    put_one(k);
  }
}

}  // namespace

/// Saves entry faces of points, and passages.
void SurfaceContactSystem::put_sides(std::vector<double>& all) const {
  all.push_back(static_cast<double>(kept_.size()));
  for (Kept const& k : kept_) {
    all.insert(all.end(), {static_cast<double>(k.point), static_cast<double>(k.rigid)});
    all.insert(all.end(), k.sides.begin(), k.sides.end());
  }
  all.push_back(static_cast<double>(deep_.size()));
  for (Deep const& d : deep_) {
    all.insert(all.end(), {static_cast<double>(d.point), static_cast<double>(d.with), d.counts ? 1.0 : 0.0});
    put(all, d.normal);
  }
  all.push_back(static_cast<double>(passed_.size()));
  for (Passed const& p : passed_)
    all.insert(all.end(), {static_cast<double>(p.of), static_cast<double>(p.through), static_cast<double>(p.points)});
}

void SurfaceContactSystem::take_sides(StateVector& from) {
  kept_.clear();
  for (auto n = from.count(); n > 0; --n) {
    Kept k{static_cast<Index>(from.next()), from.count(), {}};
    for (int& side : k.sides) side = static_cast<int>(from.next());
    kept_.push_back(k);
  }
  deep_.clear();
  for (auto n = from.count(); n > 0; --n) {
    Deep d{static_cast<std::int64_t>(from.next()), from.count(), {}, from.next() > 0};
    from.take(d.normal);
    deep_.push_back(d);
  }
  passed_.clear();
  for (auto n = from.count(); n > 0; --n)
    passed_.push_back({from.count(), from.count(), static_cast<std::int64_t>(from.next())});
}

std::vector<double> SurfaceContactSystem::state() const {
  std::vector<double> all;
  put_sides(all);
  all.insert(all.end(),
             {totals_.energy, totals_.deepest, totals_.frequency2, totals_.spring_energy, totals_.friction_work,
              static_cast<double>(totals_.touched), static_cast<double>(loaded_indices_.size())});
  for (Index const k : loaded_indices_) {
    all.push_back(k);
    put(all, forces_[at(k)]);
  }
  auto const put_between = [&](ForceMoment const& between) {
    put(all, between.force);
    put(all, between.moment);
  };
  std::for_each(on_rigid_.begin(), on_rigid_.end(), put_between);
  for (auto const& row : between_) std::for_each(row.begin(), row.end(), put_between);
  put_some(
      all, points_.size(), [&](std::size_t k) { return std::isfinite(gap_[k]) || normal_force_[k] != 0; },
      [&](std::size_t k) {
        all.insert(all.end(), {gap_[k], normal_force_[k]});
      });
  put_some(
      all, traces_.size(), [&](std::size_t k) { return traces_[k].slid != 0 || traces_[k].heat != 0; },
      [&](std::size_t k) {
        all.insert(all.end(), {traces_[k].slid, traces_[k].heat});
      });
  for (StickState const& s : stuck_) {
    all.insert(all.end(), {static_cast<double>(s.point), static_cast<double>(s.with)});
    put(all, s.stretch);
    put(all, s.force);
    all.push_back(s.energy);
  }
  return all;
}

/// As after an evaluation at x, but without forces.
void SurfaceContactSystem::place_anew(std::vector<Vec<3>> const& x) {
  std::fill(knows_F_.begin(), knows_F_.end(), 0);
  make_lists(x);
  if (!active_points_.empty()) place_points(x);
  place_shape_points();
  remember(x);
  forget_forces();
}

void SurfaceContactSystem::restore(std::vector<Vec<3>> const& x, std::vector<double> const& state) {
  PIOLA_EXPECTS(x.size() >= ids().size());
  StateVector from(state);
  take_sides(from);
  place_anew(x);
  auto const next = [&] { return from.next(); };
  totals_ = {next(), next(), next(), next(), next(), static_cast<std::int64_t>(next())};
  for (auto n = from.count(); n > 0; --n) {
    auto const k = static_cast<Index>(next());
    add_force(k, {});
    from.take(forces_[at(k)]);
  }
  auto const take_between = [&](ForceMoment& between) {
    from.take(between.force);
    from.take(between.moment);
  };
  std::for_each(on_rigid_.begin(), on_rigid_.end(), take_between);
  for (auto& row : between_) std::for_each(row.begin(), row.end(), take_between);
  for (auto n = from.count(); n > 0; --n) {
    auto const k = from.count();
    gap_[k] = next();
    normal_force_[k] = next();
  }
  std::fill(traces_.begin(), traces_.end(), SlipHistory{});
  for (auto n = from.count(); n > 0; --n) {
    auto const k = from.count();
    traces_[k] = {next(), next()};
  }
  stuck_.clear();
  while (from.any()) {
    StickState s{static_cast<std::int64_t>(next()), from.count(), {}, {}, 0};
    from.take(s.stretch);
    from.take(s.force);
    s.energy = next();
    stuck_.push_back(s);
  }
}

std::vector<SurfaceContactSystem::ParticleContactState> SurfaceContactSystem::at_particles() const {
  struct Areas {
    double pushed = 0, all = 0;
  };
  std::vector<ParticleContactState> all(at(hosts_.count()));
  std::vector<Areas> areas(all.size());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    Point const& point = points_[k];
    ParticleContactState& sum = all[at(point.host)];
    Areas& area = areas[at(point.host)];
    double const farthest = near * surfaces_[point.body].spacing;
    if (!(area.all > 0)) sum = {ids()[at(hosts_.self(point.host))], 0, farthest, 0, 0};
    area.all += point.area;
    sum.gap = std::min(sum.gap, gap_[k]);
    sum.pressure += normal_force_[k];
    if (normal_force_[k] > 0 || normal_force_[k] < 0) area.pushed += point.area;
    if (traces_.empty()) continue;
    sum.slid = std::max(sum.slid, traces_[k].slid);
    sum.heat += traces_[k].heat;
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (areas[k].pushed > 0) all[k].pressure /= areas[k].pushed;
    all[k].heat /= areas[k].all;
  }
  return all;
}

}  // namespace piola::contact
