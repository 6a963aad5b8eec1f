// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/resultants.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>

namespace piola {
namespace {

using Point = std::array<double, 3>;

Point cross(Point const& a, Point const& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Action action_of(std::string const& name, Point const& about, Impulse const& impulse, double dt) {
  Action a{name, {}, {}};
  if (!(dt > 0)) return a;
  Point const moved = cross(about, impulse.linear);
  for (std::size_t c = 0; c < 3; ++c) {
    a.force[c] = impulse.linear[c] / dt;
    a.moment[c] = (impulse.angular[c] - moved[c]) / dt;
  }
  return a;
}

}  // namespace

void ImpulseSum::add(Point const& x, Point const& p) {
  Point const moment = cross(x, p);
  double const numbers[]{p[0], p[1], p[2], moment[0], moment[1], moment[2]};
  sums_.add(numbers);
}

Impulse ImpulseSum::value() const {
  Impulse sum;
  for (std::size_t c = 0; c < 3; ++c) {
    sum.linear[c] = sums_.value(static_cast<int>(c));
    sum.angular[c] = sums_.value(static_cast<int>(c) + 3);
  }
  return sum;
}

void Impulse::add(Impulse const& other) {
  for (std::size_t c = 0; c < 3; ++c) {
    linear[c] += other.linear[c];
    angular[c] += other.angular[c];
  }
}

Resultants::Resultants(std::vector<Support> const& of_supports, std::vector<Load> const& of_loads,
                       std::vector<RigidShape> const& of_rigids) {
  for (Support const& s : of_supports) named_supports_.push_back({s.name, s.about});
  for (Load const& l : of_loads) named_loads_.push_back({l.name, l.about});
  for (RigidShape const& r : of_rigids) {
    named_rigids_.push_back({r.name, {}});
    rigid_about.push_back(r.centre);
  }
  begin(0);
}

void Resultants::begin(double dt) {
  dt_ = dt;
  supports.assign(named_supports_.size(), {});
  loads.assign(named_loads_.size(), {});
  rigids.assign(named_rigids_.size(), {});
}

std::vector<Action> Resultants::report() const {
  std::vector<Action> r;
  for (std::size_t k = 0; k < supports.size(); ++k)
    r.push_back(action_of(named_supports_[k].name, named_supports_[k].about, supports[k], dt_));
  for (std::size_t k = 0; k < loads.size(); ++k)
    if (!named_loads_[k].name.empty())
      r.push_back(action_of(named_loads_[k].name, named_loads_[k].about, loads[k], dt_));
  for (std::size_t k = 0; k < rigids.size(); ++k)
    r.push_back(action_of(named_rigids_[k].name, rigid_about[k], rigids[k], dt_));
  return r;
}

std::vector<double> Resultants::state() const {
  std::vector<double> r{dt_};
  for (auto const* list : {&supports, &loads, &rigids})
    for (Impulse const& i : *list) {
      r.insert(r.end(), i.linear.begin(), i.linear.end());
      r.insert(r.end(), i.angular.begin(), i.angular.end());
    }
  for (Point const& p : rigid_about) r.insert(r.end(), p.begin(), p.end());
  return r;
}

void Resultants::restore(std::span<double const> state) {
  PIOLA_EXPECTS(state.size() == this->state().size());
  auto from = state.begin();
  dt_ = *from++;
  auto const take = [&](Point& to) {
    std::copy_n(from, 3, to.begin());
    from += 3;
  };
  for (auto* list : {&supports, &loads, &rigids})
    for (Impulse& i : *list) {
      take(i.linear);
      take(i.angular);
    }
  for (Point& p : rigid_about) take(p);
}

}  // namespace piola
