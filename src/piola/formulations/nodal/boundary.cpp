// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/boundary.hpp"
#include <algorithm>
#include <map>

namespace piola::nodal {

Boundary::Boundary(Assembly const& assembly, std::size_t body, OfBody const& of_body)
    : body_(assembly.particles.bodies[body]),
      D_(assembly.particles.dimension),
      slot_of_(static_cast<std::size_t>(body_.last - body_.first)) {
  for (Index i = 0; i < of_body.order.particles; ++i)
    slot_of_[static_cast<std::size_t>(of_body.order.id[static_cast<std::size_t>(i)] - body_.first)] = i;
  take_supports(assembly, of_body);
  take_loads(assembly, of_body);
  of_supports_.resize(assembly.supports.size());
  of_loads_.resize(assembly.loads.size());
}

void Boundary::take_supports(Assembly const& assembly, OfBody const& of_body) {
  std::map<std::int64_t, Particle> held;
  for (auto const& support : assembly.supports) {
    auto const directions = directions_of(support, D_);
    for (auto const id : support.particles) {
      if (id < body_.first || id >= body_.last) continue;
      Index const slot = slot_of_[static_cast<std::size_t>(id - body_.first)];
      auto& particle = held[id];
      particle.slot = slot;
      particle.X = assembly.particles.X[static_cast<std::size_t>(id)];
      particle.mass = of_body.mass[static_cast<std::size_t>(slot)];
      for (auto const& d : directions) particle.rows.insert(particle.rows.begin(), {supports_.size(), d});
    }
    if (support.velocity && !is_steady(*support.velocity)) steady_supports_ = false;
    supports_.push_back(support);
    supports_.back().particles.clear();
  }
  for (auto& [id, particle] : held) particles_.push_back(std::move(particle));
}

/// Acceleration per unit of the load's value, per slot; zero where it does not act.
std::vector<double> Boundary::factors(Load const& load, std::size_t number, OfBody const& of_body) const {
  std::vector<double> factor(of_body.mass.size(), 0);
  if (load.on_face()) {
    for (std::size_t i = 0; i < of_body.parts[number].size(); ++i)
      factor[i] = of_body.parts[number][i].area / of_body.mass[i];
    return factor;
  }
  for (std::size_t k = 0; k < load.particles.size(); ++k) {
    auto const id = load.particles[k];
    if (id >= body_.first && id < body_.last)
      factor[static_cast<std::size_t>(slot_of_[static_cast<std::size_t>(id - body_.first)])] = load.factor[k];
  }
  return factor;
}

void Boundary::take_loads(Assembly const& assembly, OfBody const& of_body) {
  std::vector<Index> place(of_body.mass.size(), -1);
  for (auto const& load : assembly.loads) {
    auto const number = loads_.size();
    auto const factor = factors(load, number, of_body);
    LoadOnBody on{{}, {}, {}, {}, load.value, {}, load.until, load.follows};
    bool const steady = is_steady(load.value),
               acts = std::any_of(factor.begin(), factor.end(), [](double f) { return f != 0; });
    if (acts && (!steady || load.follows)) steady_loads_ = false;
    if (acts && load.follows) follows_ = true;
    for (std::size_t slot = 0; slot < factor.size(); ++slot) {
      if (factor[slot] == 0) continue;
      if (place[slot] < 0) {
        place[slot] = static_cast<Index>(loaded_.size());
        loaded_.push_back({static_cast<Index>(slot), of_body.mass[slot]});
        for (std::size_t c = 0; c < static_cast<std::size_t>(D_); ++c)
          loaded_.back().centroid[c] = of_body.centroid[slot * static_cast<std::size_t>(D_) + c];
      }
      on.place.push_back(place[slot]);
      on.factor.push_back(factor[slot]);
      on.X.push_back(assembly.particles.X[static_cast<std::size_t>(of_body.order.id[slot])]);
      if (load.pressure) on.normal.push_back(of_body.parts[number][slot].normal);
      if (steady) on.steady.push_back(acceleration(on, on.place.size() - 1, 0));
    }
    loads_.push_back(std::move(on));
  }
}

double Boundary::speed_of(Particle const& particle, Particle::Row const& row, double time) const {
  auto const& velocity = supports_[row.support].velocity;
  return velocity ? speed_along(*velocity, row.direction, particle.X, time) : 0;
}

/// Adds the directions in which a particle is held in a step from `time` to `end`. A direction that earlier ones partly
/// cover keeps its rest:  d = sum_k (d.q_k) q_k + length q,  so  speed = (speed of d - sum_k (d.q_k) speed_k) / length.
void Boundary::hold(Particle const& particle, double time, double end) {
  std::vector<Direction> chosen;
  std::size_t const first = held_.size();
  for (auto const& row : particle.rows) {
    if (has_ended(supports_[row.support].until, time)) continue;
    Direction d = row.direction;
    double before = speed_of(particle, row, time), after = speed_of(particle, row, end);
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      double const part = dot(row.direction, chosen[k]);
      before -= part * held_[first + k].before;
      after -= part * held_[first + k].after;
    }
    if (!make_orthogonal(d, chosen)) continue;
    double const length = dot(row.direction, d);
    chosen.push_back(d);
    held_.push_back({particle.slot, {d[0], d[1], d[2]}, particle.mass, before / length, after / length, 0, 0, 0});
    held_by_.push_back(row.support);
  }
}

Direction Boundary::acceleration(LoadOnBody const& load, std::size_t k, double time) {
  if (k < load.steady.size()) return load.steady[k];
  auto const normal = load.normal.empty() ? std::nullopt : std::optional(load.normal[k]);
  return acceleration_by(load.value, normal, load.factor[k], load.X[k], time);
}

Direction Boundary::acting(LoadOnBody const& load, std::size_t k, bool at_end, double time) const {
  Direction const a = acceleration(load, k, time);
  if (!load.follows) return a;
  double const* const turn = loaded_[static_cast<std::size_t>(load.place[k])].turn[at_end];
  Direction turned{};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t d = 0; d < 3; ++d) turned[c] += turn[3 * c + d] * a[d];
  return turned;
}

/// Adds the loads that act in a step that begins at `time`.
void Boundary::add_loads(double time, double evaluate_at, bool at_end) {
  for (auto const& load : loads_) {
    if (has_ended(load.until, time)) continue;
    for (std::size_t k = 0; k < load.place.size(); ++k) {
      Direction const a = acceleration(load, k, evaluate_at);
      auto& p = loaded_[static_cast<std::size_t>(load.place[k])];
      double* const side = load.follows ? (at_end ? p.follow_after : p.follow_before) : at_end ? p.after : p.before;
      for (std::size_t c = 0; c < 3; ++c) side[c] += a[c];
    }
  }
}

void Boundary::attach(BodyState& state) {
  begin_step(state, 0, 0);
  for (auto const& h : held_) {
    double now = 0;
    for (int c = 0; c < D_; ++c) now += h.direction[c] * value_at(state.v, h.slot, c);
    for (int c = 0; c < D_; ++c) value_at(state.v, h.slot, c) += (h.before - now) * h.direction[c];
  }
}

void Boundary::begin_step(BodyState& state, double time, double dt) {
  int released = 0;
  for (auto const& s : supports_) released += has_ended(s.until, time) ? 1 : 0;
  for (auto const& l : loads_) released += has_ended(l.until, time) ? 1 : 0;
  bool const changed = released != released_;
  released_ = released;
  begun_ = time;
  if (changed || !steady_supports_) {
    held_.clear();
    held_by_.clear();
    for (auto const& particle : particles_) hold(particle, time, time + dt);
  }
  if (changed || !steady_loads_) {
    for (auto& p : loaded_)
      for (std::size_t c = 0; c < 3; ++c) p.before[c] = p.after[c] = p.follow_before[c] = p.follow_after[c] = 0;
    add_loads(time, time, false);
    add_loads(time, time + dt, true);
  }
  state.held = held_.data();
  state.held_count = static_cast<Index>(held_.size());
  state.loaded = loaded_.data();
  state.loaded_count = static_cast<Index>(loaded_.size());
  state.follows = follows_;
}

/// Each kick acts where the particle is then, so that the moments are those that angular momentum feels.
void Boundary::end_step(BodyState& state, double time) {
  auto const place_of = [&](FieldRef const& field, Index slot) {
    std::array<double, 3> x{};
    for (int c = 0; c < D_; ++c) x[static_cast<std::size_t>(c)] = value_at(field, slot, c);
    return x;
  };
  for (std::size_t k = 0; k < held_.size(); ++k) {
    auto const& h = held_[k];
    work_ += h.work;
    auto const along = [&](double impulse) {
      return Direction{impulse * h.direction[0], impulse * h.direction[1], impulse * h.direction[2]};
    };
    of_supports_[held_by_[k]].add(place_of(state.kept, h.slot), along(h.first_impulse));
    of_supports_[held_by_[k]].add(place_of(state.x, h.slot), along(h.impulse - h.first_impulse));
  }
  for (auto const& p : loaded_) work_ += p.work;
  for (std::size_t l = 0; l < loads_.size(); ++l) {
    auto const& load = loads_[l];
    if (has_ended(load.until, begun_)) continue;
    bool const ends = has_ended(load.until, time);
    for (std::size_t k = 0; k < load.place.size(); ++k) {
      auto const& p = loaded_[static_cast<std::size_t>(load.place[k])];
      Direction first = acting(load, k, false, begun_), second = acting(load, k, true, time);
      for (int c = 0; ends && c < D_; ++c) value_at(state.a, p.slot, c) -= second[static_cast<std::size_t>(c)];
      for (std::size_t c = 0; c < 3; ++c) {
        double const kick = static_cast<int>(c) < D_ ? 0.5 * (time - begun_) * p.mass : 0;
        first[c] *= kick;
        second[c] *= kick;
      }
      of_loads_[l].add(place_of(state.kept, p.slot), first);
      of_loads_[l].add(place_of(state.x, p.slot), second);
    }
  }
}

void Boundary::hand_over(Actions& actions) {
  for (std::size_t s = 0; s < of_supports_.size(); ++s) actions.supports[s].add(of_supports_[s]);
  for (std::size_t l = 0; l < of_loads_.size(); ++l) actions.loads[l].add(of_loads_[l]);
  of_supports_.assign(of_supports_.size(), {});
  of_loads_.assign(of_loads_.size(), {});
}

void Boundary::damp(BodyState& state, double factor) const {
  std::vector<double> before;
  auto const along = [&](HeldDirection const& h) {
    double sum = 0;
    for (int c = 0; c < D_; ++c) sum += h.direction[c] * value_at(state.v, h.slot, c);
    return sum;
  };
  for (auto const& h : held_) before.push_back(along(h));
  for (Index i = 0; i < state.slots.last; ++i)
    for (int c = 0; c < D_; ++c) value_at(state.v, i, c) *= factor;
  for (std::size_t k = 0; k < held_.size(); ++k) {
    double const change = before[k] - along(held_[k]);
    for (int c = 0; c < D_; ++c) value_at(state.v, held_[k].slot, c) += change * held_[k].direction[c];
  }
}

double Boundary::next_release(double time) const {
  double next = std::numeric_limits<double>::infinity();
  for (auto const& s : supports_)
    if (!has_ended(s.until, time)) next = std::min(next, s.until);
  for (auto const& l : loads_)
    if (!has_ended(l.until, time)) next = std::min(next, l.until);
  return next;
}

}  // namespace piola::nodal
