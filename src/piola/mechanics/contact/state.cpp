// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/system.hpp"
#include <algorithm>
#include <cmath>

namespace piola::contact {

std::vector<double> System::state() const {
  std::vector<double> all{totals_.energy,
                          totals_.deepest,
                          totals_.frequency2,
                          totals_.spring_energy,
                          totals_.friction_work,
                          static_cast<double>(totals_.touched),
                          static_cast<double>(pushed_.size())};
  auto const put = [&](Vec<3> const& a) { all.insert(all.end(), a.c, a.c + 3); };
  for (Index const k : pushed_) {
    all.push_back(k);
    put(forces_[at(k)]);
  }
  auto const put_between = [&](Between const& between) {
    put(between.force);
    put(between.moment);
  };
  std::for_each(on_rigid_.begin(), on_rigid_.end(), put_between);
  for (auto const& row : between_) std::for_each(row.begin(), row.end(), put_between);
  auto const put_some = [&](auto const& holds, auto const& put_one) {
    std::size_t const count = all.size();
    all.push_back(0);
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (!holds(k)) continue;
      all[count] += 1;
      all.push_back(static_cast<double>(k));
      put_one(k);
    }
  };
  put_some([&](std::size_t k) { return std::isfinite(gap_[k]) || normal_force_[k] != 0; },
           [&](std::size_t k) {
             all.insert(all.end(), {gap_[k], normal_force_[k]});
           });
  put_some([&](std::size_t k) { return k < traces_.size() && (traces_[k].slid != 0 || traces_[k].heat != 0); },
           [&](std::size_t k) {
             all.insert(all.end(), {traces_[k].slid, traces_[k].heat});
           });
  for (Stuck const& s : stuck_) {
    all.push_back(s.point);
    all.push_back(static_cast<double>(s.with));
    put(s.stretch);
    put(s.force);
    all.push_back(s.energy);
  }
  return all;
}

void System::restore(std::vector<Vec<3>> const& x, std::vector<double> const& state) {
  std::fill(knows_F_.begin(), knows_F_.end(), 0);
  make_lists(x);
  if (!active_points_.empty()) place_points(x);
  remember(x);
  forget_forces();
  auto from = state.begin();
  auto const number = [&] { return *from++; };
  auto const take = [&](Vec<3>& a) {
    std::copy_n(from, 3, a.c);
    from += 3;
  };
  totals_ = {number(), number(), number(), number(), number(), static_cast<std::int64_t>(number())};
  for (auto n = static_cast<std::size_t>(number()); n > 0; --n) {
    auto const k = static_cast<Index>(number());
    add_force(k, {});
    take(forces_[at(k)]);
  }
  auto const take_between = [&](Between& between) {
    take(between.force);
    take(between.moment);
  };
  std::for_each(on_rigid_.begin(), on_rigid_.end(), take_between);
  for (auto& row : between_) std::for_each(row.begin(), row.end(), take_between);
  std::fill(traces_.begin(), traces_.end(), Trace{});
  for (auto n = static_cast<std::size_t>(number()); n > 0; --n) {
    auto const k = static_cast<std::size_t>(number());
    gap_[k] = number();
    normal_force_[k] = number();
  }
  for (auto n = static_cast<std::size_t>(number()); n > 0; --n) {
    auto const k = static_cast<std::size_t>(number());
    traces_[k].slid = number();
    traces_[k].heat = number();
  }
  stuck_.clear();
  while (from < state.end()) {
    Stuck s{static_cast<Index>(number()), static_cast<std::size_t>(number()), {}, {}, 0};
    take(s.stretch);
    take(s.force);
    s.energy = number();
    stuck_.push_back(s);
  }
}

std::vector<System::AtParticle> System::at_particles() const {
  struct Areas {
    double pushed = 0, all = 0;
  };
  std::vector<AtParticle> all(at(carriers_.count()));
  std::vector<Areas> areas(all.size());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    Point const& point = points_[k];
    AtParticle& sum = all[at(point.carrier)];
    Areas& area = areas[at(point.carrier)];
    double const farthest = near * surfaces_[point.body].spacing;
    if (!(area.all > 0)) sum = {ids()[at(carriers_.self(point.carrier))], 0, farthest, 0, 0};
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
