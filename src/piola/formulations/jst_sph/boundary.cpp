// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/boundary.hpp"
#include "piola/formulations/prescribed.hpp"
#include "piola/materials/solids.hpp"
#include "piola/math/tensor.hpp"
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

Point place_of(BodyState const& state, Index slot, int D) {
  Point x{};
  for (int c = 0; c < D; ++c) x[static_cast<std::size_t>(c)] = value_at(state.x, slot, c);
  return x;
}

/// The acceleration by a pressure that follows the face: cof F a.
Point turned_with(BodyState const& state, Index slot, Point const& a, int D) {
  Mat<3> F = identity<3>();
  for (int c = 0; c < D * D; ++c) F(c / D, c % D) = value_at(state.F, slot, c);
  Mat<3> const H = cofactor(F);
  Point r{};
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) r[static_cast<std::size_t>(i)] += H(i, j) * a[static_cast<std::size_t>(j)];
  return r;
}

/// What a load does to its particle k at X, where its face is not deformed.
template <class L>
Point load_acceleration(L const& load, std::size_t k, Point const& X, double time) {
  return acceleration_by(load.value, load.pressure ? std::optional(load.normal_of(k)) : std::nullopt, load.factor[k], X,
                         time);
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

/// One component of a particle is held once; the support named last answers for it, mirrors only if no other does.
void Boundary::add_plain(SupportComponent const& component, PlainOwner const& owner, std::size_t& place,
                         bool is_mirror) {
  if (place == 0) {
    plain_.push_back(component);
    plain_owner_.push_back(owner);
    place = plain_.size();
  } else if (!is_mirror) {
    plain_owner_[place - 1] = owner;
  }
}

void Boundary::take_supports(Assembly const& assembly, std::vector<Support> const& mirrors,
                             std::vector<Index> const& slot_of) {
  std::vector<Support> supports = assembly.supports;
  supports.insert(supports.end(), mirrors.begin(), mirrors.end());
  std::map<std::int64_t, std::size_t> moved;           // particles with supports that are more than plain
  std::map<std::pair<Index, int>, std::size_t> plain;  // places of components in plain_, from 1 on
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
          double const mass = rho0_ * assembly.particles.volume[static_cast<std::size_t>(id)];
          add_plain({slot, axis_of(d), 0, 0, 0, 0}, {driven_.size(), mass}, plain[{slot, axis_of(d)}],
                    driven_.size() >= assembly.supports.size());
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
  of_support_.resize(driven_.size());
}

void Boundary::take_loads(Assembly const& assembly, std::vector<Index> const& slot_of) {
  std::vector<Index> place(slot_of.size(), SlotOrder::no_particle);
  for (auto const& load : assembly.loads) {
    LoadOnBody on;
    on.value = load.value;
    on.steady = is_steady(load.value);
    on.until = load.until;
    on.named = !load.name.empty();
    on.pressure = load.pressure;
    on.follows = load.follows;
    for (std::size_t k = 0; k < load.particles.size(); ++k) {
      auto const id = load.particles[k];
      if (id < body_.first || id >= body_.last) continue;
      auto const local = static_cast<std::size_t>(id - body_.first), at = static_cast<std::size_t>(id);
      if (place[local] == SlotOrder::no_particle) {
        place[local] = static_cast<Index>(loaded_.size());
        loaded_.push_back({slot_of[local], rho0_ * assembly.particles.volume[at], {}, {}, {}, {}, 0});
      }
      on.place.push_back(place[local]);
      on.factor.push_back(load.factor[k]);
      if (load.pressure) on.normal.push_back(load.normal_of(k));
      on.X.push_back(assembly.particles.X[at]);
      if (!on.steady) continue;
      on.acceleration.push_back(load_acceleration(load, k, on.X.back(), 0));
    }
    loads_.push_back(std::move(on));
  }
  of_load_.resize(loads_.size());
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
  HeldDirection h{p.slot, axis_of(d), true, {d[0], d[1], d[2]}, 0, p.mass, cloud_.has_value(), 0, 0, 0, 0, 0, 0, 0};
  h.support = static_cast<std::int32_t>(p.rows[row].support);
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

std::array<double, 3> Boundary::acceleration_of(LoadOnBody const& load, std::size_t k, double time) {
  if (load.steady) return load.acceleration[k];
  return load_acceleration(load, k, load.X[k], time);
}

/// add(load, k, acceleration) for every particle k of every load that acts in a step that begins at `time`.
template <class Add>
void Boundary::each_load(double time, double evaluate_at, Add const& add) const {
  for (auto const& load : loads_) {
    if (has_ended(load.until, time)) continue;
    for (std::size_t k = 0; k < load.place.size(); ++k) {
      add(load, static_cast<std::size_t>(load.place[k]), acceleration_of(load, k, evaluate_at));
    }
  }
}

/// Loads at the start and at the end of a step; `follows`: the start is where the last step ended.
void Boundary::evaluate_loads(double time, double end, bool follows) {
  for (auto& p : loaded_)
    for (auto* const part : {p.dead, p.follow})
      for (int c = 0; c < 3; ++c) {
        part[0][c] = follows ? part[1][c] : 0;
        part[1][c] = 0;
      }
  auto const into = [&](int side) {
    return [this, side](LoadOnBody const& load, std::size_t k, Point const& a) {
      auto& part = load.follows ? loaded_[k].follow : loaded_[k].dead;
      for (std::size_t c = 0; c < 3; ++c) part[side][c] += a[c];
    };
  };
  if (!follows) each_load(time, time, into(0));
  each_load(time, end, into(1));
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
  if (multipliers_) multipliers_->forget_impulses();
  state.held = held_.data();
  state.held_count = static_cast<Index>(held_.size());
  state.multipliers = multipliers_ ? &*multipliers_ : nullptr;
  state.enforce = [](Multipliers& multipliers, BodyState& body, MultiplierCall const& call) {
    multipliers.enforce(body, call);
  };
  state.loaded = loaded_.data();
  state.loaded_count = static_cast<Index>(loaded_.size());
  note_places(state);
}

void Boundary::end_step(BodyState& state, double time) {
  for (auto const& h : held_) state.totals.external_work += h.work;
  for (auto const& p : loaded_) state.totals.external_work += p.work;
  sum_impulses(state);
  if (state.constants.integrator == Integrator::verlet) end_loads(state, time);
}

/// Loads that end now leave the acceleration with which the next step begins.
void Boundary::end_loads(BodyState& state, double time) {
  each_load(begun_, time, [&](LoadOnBody const& load, std::size_t k, Point const& reference) {
    if (!has_ended(load.until, time)) return;
    Point const a = load.follows ? turned_with(state, loaded_[k].slot, reference, D_) : reference;
    for (int c = 0; c < D_; ++c) value_at(state.rate, loaded_[k].slot, c) -= a[static_cast<std::size_t>(c)];
  });
  for (SupportComponent& s : plain_) {
    double& rate = value_at(state.rate, s.slot, s.component);
    s.removed -= rate;
    rate = 0;
  }
}

void Boundary::note_places(BodyState const& state) {
  auto const places = [&](auto const& items, std::vector<Point>& to) {
    to.clear();
    for (auto const& item : items) to.push_back(place_of(state, item.slot, D_));
  };
  places(plain_, plain_start_);
  places(held_, held_start_);
  if (std::any_of(loads_.begin(), loads_.end(), [](auto const& l) { return l.named; })) places(loaded_, loaded_start_);
  for (auto& load : loads_) {
    load.at_start.clear();
    for (std::size_t k = 0; load.named && load.follows && k < load.place.size(); ++k) {
      Index const slot = loaded_[static_cast<std::size_t>(load.place[k])].slot;
      load.at_start.push_back(turned_with(state, slot, acceleration_of(load, k, begun_), D_));
    }
  }
}

/// Impulses at the places of the start and of the end of the step, as the step itself divides them: the angular
/// momentum then changes by just their moments.
void Boundary::sum_impulses(BodyState const& state) {
  of_support_.assign(of_support_.size(), {});
  of_load_.assign(of_load_.size(), {});
  for (std::size_t k = 0; k < plain_.size(); ++k) {
    SupportComponent const& s = plain_[k];
    Point before{}, after{};
    before[static_cast<std::size_t>(s.component)] = plain_owner_[k].mass * s.at_start;
    after[static_cast<std::size_t>(s.component)] = plain_owner_[k].mass * s.at_end;
    of_support_[plain_owner_[k].support].add(plain_start_[k], before);
    of_support_[plain_owner_[k].support].add(place_of(state, s.slot, D_), after);
  }
  for (std::size_t k = 0; k < held_.size(); ++k) {
    HeldDirection const& h = held_[k];
    Impulse& to = of_support_[static_cast<std::size_t>(h.support)];
    auto const along = [&](double change) {
      double const p = h.mass * change;
      return Point{p * h.direction[0], p * h.direction[1], p * h.direction[2]};
    };
    to.add(held_start_[k], along(h.at_start));
    to.add(place_of(state, h.slot, D_), along(h.at_end));
  }
  for (std::size_t l = 0; l < loads_.size(); ++l) {
    if (!loads_[l].named || has_ended(loads_[l].until, begun_)) continue;
    for (std::size_t k = 0; k < loads_[l].place.size(); ++k) {
      auto const at = static_cast<std::size_t>(loads_[l].place[k]);
      Point before = loads_[l].follows ? loads_[l].at_start[k] : acceleration_of(loads_[l], k, begun_);
      Point after = acceleration_of(loads_[l], k, ended_);
      if (loads_[l].follows) after = turned_with(state, loaded_[at].slot, after, D_);
      for (std::size_t c = 0; c < 3; ++c) {
        double const half = static_cast<int>(c) < D_ ? 0.5 * (ended_ - begun_) * loaded_[at].mass : 0;
        before[c] *= half;
        after[c] *= half;
      }
      of_load_[l].add(loaded_start_[at], before);
      of_load_[l].add(place_of(state, loaded_[at].slot, D_), after);
    }
  }
}

void Boundary::damp(BodyState& state, double factor) const {
  std::vector<double> along;
  for (auto const& h : held_) {
    along.push_back(0);
    for (int c = 0; c < D_; ++c) along.back() += h.direction[c] * value_at(state.v, h.slot, c);
  }
  for (Index i = 0; i < state.slots.last; ++i)
    for (int c = 0; c < D_; ++c) value_at(state.v, i, c) *= factor;
  for (std::size_t k = 0; k < held_.size(); ++k)
    for (int c = 0; c < D_; ++c) value_at(state.v, held_[k].slot, c) += (1 - factor) * along[k] * held_[k].direction[c];
}

void Boundary::add_actions(Actions& actions) const {
  for (std::size_t k = 0; k < actions.supports.size(); ++k) actions.supports[k].add(of_support_[k]);
  for (std::size_t k = 0; k < actions.loads.size(); ++k) actions.loads[k].add(of_load_[k]);
  for (std::size_t k = 0; multipliers_ && k < multipliers_->impulses().size() && k < actions.supports.size(); ++k)
    actions.supports[k].add(multipliers_->impulses()[k]);
}

std::vector<double> Boundary::state() const {
  std::vector<double> r;
  for (SupportComponent const& s : plain_) r.push_back(s.removed);
  return r;
}

void Boundary::restore(std::vector<double> const& state) {
  for (std::size_t k = 0; k < plain_.size(); ++k) plain_[k].removed = state[k];
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
