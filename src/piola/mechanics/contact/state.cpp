// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/system.hpp"
#include <algorithm>

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
  for (Stuck const& s : stuck_) {
    all.push_back(s.point);
    all.push_back(static_cast<double>(s.with));
    put(s.stretch);
    put(s.force);
  }
  return all;
}

void System::restore(std::vector<Vec<3>> const& x, std::vector<double> const& state) {
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
  stuck_.clear();
  while (from < state.end()) {
    Stuck s{static_cast<Index>(number()), static_cast<std::size_t>(number()), {}, {}};
    take(s.stretch);
    take(s.force);
    stuck_.push_back(s);
  }
}

}  // namespace piola::contact
