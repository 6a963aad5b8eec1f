// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/boundary.hpp"
#include "piola/formulations/prescribed.hpp"
#include "piola/materials/solids.hpp"
#include <algorithm>
#include <cmath>
#include <map>

namespace piola::jst_sph {
namespace {

using Point = std::array<double, 3>;

/// Whether a support does nothing but hold components at rest for the whole run.
bool is_plain(Support const& s) {
  return s.frame == Support::Frame::axes && !s.velocity && s.until == std::numeric_limits<double>::infinity();
}

int axis_of(Point const& d) {
  for (int c = 0; c < 3; ++c)
    if (d[static_cast<std::size_t>(c)] == 1) return c;
  return -1;
}

}  // namespace

Boundary::Boundary(Assembly const& assembly, std::size_t body, SlotOrder const& order,
                   std::vector<Support> const& mirrors, std::optional<Cloud> cloud)
    : body_(assembly.particles.bodies[body]), D_(assembly.particles.dimension), cloud_(std::move(cloud)) {
  with_any_law(assembly.materials[body], [&](auto const& law) { rho0_ = law.rho0; });
  std::vector<Index> slot_of(static_cast<std::size_t>(body_.last - body_.first));
  for (Index i = 0; i < order.particles; ++i)
    slot_of[static_cast<std::size_t>(order.id[static_cast<std::size_t>(i)] - body_.first)] = i;
  take_supports(assembly, mirrors, slot_of);
  take_loads(assembly, slot_of);
}

void Boundary::take_supports(Assembly const& assembly, std::vector<Support> const& mirrors,
                             std::vector<Index> const& slot_of) {
  std::vector<Support> supports = assembly.supports;
  supports.insert(supports.end(), mirrors.begin(), mirrors.end());
  std::map<std::int64_t, std::size_t> moved;  // particles with supports that are more than plain
  auto const of_body = [&](std::int64_t id) { return id >= body_.first && id < body_.last; };
  for (auto const& support : supports)
    for (auto const id : support.particles)
      if (of_body(id) && (cloud_ || !is_plain(support))) moved.try_emplace(id, 0);
  for (auto& [id, place] : moved) {
    auto const at = static_cast<std::size_t>(id);
    Point position = assembly.particles.X[at];
    for (std::size_t c = 0; c < 3 && !assembly.initial_displacement.empty(); ++c)
      position[c] += assembly.initial_displacement[at][c];
    place = particles_.size();
    particles_.push_back({slot_of[static_cast<std::size_t>(id - body_.first)],
                          assembly.particles.X[at],
                          rho0_ * assembly.particles.volume[at],
                          position,
                          {}});
  }
  for (auto const& support : supports) {
    auto const directions = directions_of(support, D_);
    for (auto const id : support.particles) {
      if (!of_body(id)) continue;
      Index const slot = slot_of[static_cast<std::size_t>(id - body_.first)];
      auto const found = moved.find(id);
      for (auto const& d : directions) {
        if (found == moved.end()) {
          plain_.push_back({slot, axis_of(d), 0});
          continue;
        }
        auto& p = particles_[found->second];
        Row row{driven_.size(), d, 0, !support.velocity};
        if (support.velocity && is_steady(*support.velocity)) {
          row.speed = speed_along(*support.velocity, d, p.X, 0);
          row.at_rest = row.speed == 0;
        }
        p.rows.insert(p.rows.begin(), row);
      }
    }
    driven_.push_back(support);
    driven_.back().particles.clear();
    steady_.push_back(!support.velocity || is_steady(*support.velocity));
  }
}

void Boundary::take_loads(Assembly const& assembly, std::vector<Index> const& slot_of) {
  std::vector<Index> place(slot_of.size(), SlotOrder::no_particle);
  for (auto const& load : assembly.loads) {
    LoadOnBody on;
    on.value = load.value;
    on.steady = is_steady(load.value);
    on.until = load.until;
    for (std::size_t k = 0; k < load.particles.size(); ++k) {
      auto const id = load.particles[k];
      if (id < body_.first || id >= body_.last) continue;
      auto const local = static_cast<std::size_t>(id - body_.first), at = static_cast<std::size_t>(id);
      if (place[local] == SlotOrder::no_particle) {
        place[local] = static_cast<Index>(loaded_.size());
        loaded_.push_back({slot_of[local], rho0_ * assembly.particles.volume[at], {}, {}, 0});
      }
      on.place.push_back(place[local]);
      on.factor.push_back(load.factor[k]);
      on.X.push_back(assembly.particles.X[at]);
      if (!on.steady) continue;
      on.acceleration.push_back({});
      for (std::size_t c = 0; c < 3; ++c) on.acceleration.back()[c] = load.factor[k] * load.value[c](on.X.back());
    }
    loads_.push_back(std::move(on));
  }
}

void Boundary::attach(BodyState& state) {
  for (auto& s : plain_) {
    s.position = value_at(state.x, s.slot, s.component);
    value_at(state.v, s.slot, s.component) = 0;
  }
  state.supports = plain_.data();
  state.support_count = static_cast<Index>(plain_.size());
  begin_step(state, 0, 0);
  for (auto const& h : held_) {
    double now = 0;
    for (int c = 0; c < D_; ++c) now += h.direction[c] * value_at(state.v, h.slot, c);
    for (int c = 0; c < D_; ++c) {
      double& v = value_at(state.v, h.slot, c);
      v = c == h.axis ? h.speed : v + (h.speed - now) * h.direction[c];
    }
  }
  if (multipliers_) multipliers_->enforce(state, {MultiplierCall::When::start, 0});
}

/// Adds the part of a row that the directions chosen so far leave free.
void Boundary::add_direction(std::size_t particle, std::size_t row) {
  Particle const& p = particles_[particle];
  Point d = p.rows[row].direction;
  std::vector<Point> chosen;
  auto first = held_.size();
  while (first > 0 && held_[first - 1].slot == p.slot) --first;
  Origin origin{particle, {}, {}, 0};
  // d = sum_k (d.q_k) q_k + length q, so that speed = (speed of the row - sum_k (d.q_k) speed_k) / length.
  std::vector<double> of_row(p.rows.size(), 0);
  of_row[row] = 1;
  for (auto k = first; k < held_.size(); ++k) {
    auto const& q = held_[k].direction;
    chosen.push_back({q[0], q[1], q[2]});
    double const part = dot(d, chosen.back());
    for (int s = 0; s < origins_[k].count; ++s)
      of_row[origins_[k].row[static_cast<std::size_t>(s)]] -= part * origins_[k].weight[static_cast<std::size_t>(s)];
  }
  Point const given = d;
  if (!make_orthogonal(d, chosen)) return;
  double const length = dot(given, d);
  HeldDirection h{p.slot, axis_of(d), true, {d[0], d[1], d[2]}, 0, p.mass, cloud_.has_value(), 0, 0, 0, 0};
  for (std::size_t r = 0; r < of_row.size(); ++r) {
    if (of_row[r] == 0) continue;
    origin.row[static_cast<std::size_t>(origin.count)] = r;
    origin.weight[static_cast<std::size_t>(origin.count++)] = of_row[r] / length;
  }
  // It keeps its place only if nothing has moved it before, either.
  for (auto const& other : p.rows)
    if (dot(other.direction, d) != 0 && (cloud_ || !other.at_rest)) h.at_rest = false;
  if (h.axis >= 0) h.position = p.position[static_cast<std::size_t>(h.axis)];
  held_.push_back(h);
  origins_.push_back(origin);
}

/// The directions in which particles are held from `time` on. Where two supports ask for different velocities in one
/// direction, the one named last has its way.
void Boundary::choose_directions(double time) {
  held_.clear();
  origins_.clear();
  for (std::size_t k = 0; k < particles_.size(); ++k)
    for (std::size_t r = 0; r < particles_[k].rows.size(); ++r)
      if (!has_ended(driven_[particles_[k].rows[r].support].until, time)) add_direction(k, r);
  if (cloud_) multipliers_.emplace(held_, *cloud_);
}

void Boundary::evaluate_speeds(double time) {
  for (auto& p : particles_)
    for (auto& row : p.rows)
      if (!steady_[row.support]) row.speed = speed_along(*driven_[row.support].velocity, row.direction, p.X, time);
  for (std::size_t k = 0; k < held_.size(); ++k) {
    auto const& origin = origins_[k];
    held_[k].speed = 0;
    for (std::size_t s = 0; s < static_cast<std::size_t>(origin.count); ++s)
      held_[k].speed += origin.weight[s] * particles_[origin.particle].rows[origin.row[s]].speed;
  }
}

/// add(load, k, acceleration) for every particle k of every load that acts in a step that begins at `time`.
template <class Add>
void Boundary::each_load(double time, double evaluate_at, Add const& add) const {
  for (auto const& load : loads_) {
    if (has_ended(load.until, time)) continue;
    for (std::size_t k = 0; k < load.place.size(); ++k) {
      Point a{};
      if (load.steady)
        a = load.acceleration[k];
      else
        for (std::size_t c = 0; c < 3; ++c) a[c] = load.factor[k] * load.value[c](load.X[k], evaluate_at);
      add(load, static_cast<std::size_t>(load.place[k]), a);
    }
  }
}

/// Loads at the start and at the end of a step; `follows`: the start is where the last step ended.
void Boundary::evaluate_loads(double time, double end, bool follows) {
  for (auto& p : loaded_)
    for (int c = 0; c < 3; ++c) {
      p.before[c] = follows ? p.after[c] : 0;
      p.after[c] = 0;
    }
  auto const into = [&](double(LoadedParticle::*side)[3]) {
    return [this, side](LoadOnBody const&, std::size_t k, Point const& a) {
      for (std::size_t c = 0; c < 3; ++c) (loaded_[k].*side)[c] += a[c];
    };
  };
  if (!follows) each_load(time, time, into(&LoadedParticle::before));
  each_load(time, end, into(&LoadedParticle::after));
}

void Boundary::begin_step(BodyState& state, double time, double dt) {
  int released = 0;
  for (auto const& s : driven_) released += has_ended(s.until, time) ? 1 : 0;
  for (auto const& l : loads_) released += has_ended(l.until, time) ? 1 : 0;
  bool const changed = released != released_;
  released_ = released;
  bool const follows = !changed && time == ended_;
  begun_ = time;
  ended_ = time + dt;
  if (changed) choose_directions(time);
  bool const timed_speeds = std::find(steady_.begin(), steady_.end(), false) != steady_.end();
  if (cloud_ && (changed || timed_speeds)) {
    evaluate_speeds(time);
    for (auto& h : held_) h.start_speed = h.speed;
  }
  if (changed || timed_speeds) evaluate_speeds(time + dt);
  bool const timed_loads = std::any_of(loads_.begin(), loads_.end(), [](auto const& l) { return !l.steady; });
  if (changed || timed_loads) evaluate_loads(time, time + dt, follows);
  state.held = held_.data();
  state.held_count = static_cast<Index>(held_.size());
  state.multipliers = multipliers_ ? &*multipliers_ : nullptr;
  state.enforce = [](Multipliers& multipliers, BodyState& body, MultiplierCall const& call) {
    multipliers.enforce(body, call);
  };
  state.loaded = loaded_.data();
  state.loaded_count = static_cast<Index>(loaded_.size());
}

void Boundary::end_step(BodyState& state, double time) {
  for (auto const& h : held_) state.totals.external_work += h.work;
  for (auto const& p : loaded_) state.totals.external_work += p.work;
  if (state.constants.integrator != Integrator::verlet) return;
  each_load(begun_, time, [&](LoadOnBody const& load, std::size_t k, Point const& a) {
    if (!has_ended(load.until, time)) return;
    for (int c = 0; c < D_; ++c) value_at(state.rate, loaded_[k].slot, c) -= a[static_cast<std::size_t>(c)];
  });
}

double Boundary::next_release(double time) const {
  double next = std::numeric_limits<double>::infinity();
  auto const see = [&](double until) {
    if (!has_ended(until, time)) next = std::min(next, until);
  };
  for (auto const& s : driven_) see(s.until);
  for (auto const& l : loads_) see(l.until);
  return next;
}

}  // namespace piola::jst_sph
