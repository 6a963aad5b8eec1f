// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/body_boundary_conditions.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include <algorithm>
#include <map>

namespace piola {
namespace {

constexpr Index no_place = -1;

int axis_of(Direction const& d) {
  for (int c = 0; c < 3; ++c)
    if (d[static_cast<std::size_t>(c)] == 1) return c;
  return -1;
}

double along(FieldRef const& v, PrescribedDirection const& h, int D) {
  double sum = 0;
  for (int c = 0; c < D; ++c) sum += h.direction[c] * value_at(v, h.slot, c);
  return sum;
}

}  // namespace

BodyBoundary::BodyBoundary(int dimension, std::vector<Support> const& supports, std::vector<Load> const& loads,
                           bool multiplied)
    : D_(dimension), multiplied_(multiplied), of_supports_(supports.size()), of_loads_(loads.size()) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  for (Support const& support : supports) {
    supports_.push_back(support);
    supports_.back().particles.clear();
    if (support.velocity && !is_steady(*support.velocity)) steady_supports_ = false;
  }
  for (Load const& load : loads) {
    loads_.push_back({load});
    LoadOnBody& on = loads_.back();
    on.particles.clear();
    on.factor.clear();
    on.normals.clear();
    on.steady = is_steady(load.value);
    steady_loads_ = steady_loads_ && on.steady;
    named_loads_ = named_loads_ || !load.name.empty();
  }
}

std::size_t BodyBoundary::add_particle(PrescribedParticle const& particle) {
  PIOLA_EXPECTS(particle.slot >= 0);
  particles_.push_back({particle, {}});
  return particles_.size() - 1;
}

void BodyBoundary::add_row(std::size_t particle, std::size_t support, Direction const& direction) {
  PIOLA_EXPECTS(particle < particles_.size() && support < supports_.size());
  Particle& p = particles_[particle];
  auto const& velocity = supports_[support].velocity;
  Row row{support, direction, 0, !velocity};
  if (velocity && is_steady(*velocity)) {
    row.speed = speed_along(*velocity, direction, p.of.X, 0);
    row.at_rest = row.speed == 0;
  }
  p.rows.insert(p.rows.begin(), row);
}

void BodyBoundary::add_supports(std::vector<Support> const& supports, std::function<bool(std::int64_t id)> const& takes,
                                std::function<PrescribedParticle(std::int64_t id)> const& particle_of) {
  PIOLA_EXPECTS(supports.size() == supports_.size());
  PIOLA_EXPECTS(takes != nullptr && particle_of != nullptr);
  std::map<std::int64_t, std::size_t> numbers;  // in the order of ids
  for (Support const& support : supports)
    for (auto const id : support.particles)
      if (!support.on_surface() && takes(id)) numbers.try_emplace(id, 0);
  for (auto& [id, number] : numbers) number = add_particle(particle_of(id));
  for (std::size_t s = 0; s < supports.size(); ++s) {
    if (supports[s].on_surface()) continue;
    auto const directions = directions_of(supports[s], D_);
    for (auto const id : supports[s].particles) {
      auto const found = numbers.find(id);
      if (found == numbers.end()) continue;
      for (auto const& d : directions) add_row(found->second, s, d);
    }
  }
}

void BodyBoundary::add_load(std::size_t load, LoadedPlace const& place) {
  PIOLA_EXPECTS(load < loads_.size() && place.slot >= 0);
  auto const slot = static_cast<std::size_t>(place.slot);
  if (slot >= place_of_slot_.size()) place_of_slot_.resize(slot + 1, no_place);
  if (place_of_slot_[slot] == no_place) {
    place_of_slot_[slot] = static_cast<Index>(loaded_.size());
    loaded_.push_back({place.slot, place.mass});
  }
  LoadItem item{static_cast<std::size_t>(place_of_slot_[slot]), place.factor, place.X, place.normal, {}};
  if (loads_[load].steady) item.steady = acceleration_by(loads_[load].value, place.normal, place.factor, place.X, 0);
  loads_[load].items.push_back(item);
}

void BodyBoundary::keep(Range own) {
  PIOLA_EXPECTS(own.first <= own.last);
  PIOLA_EXPECTS(released_ < 0);
  share(own);
  first_kept_ = own.first;
  if (multiplied_) return;
  std::erase_if(particles_, [&](Particle const& p) { return !is_local(own, p.of.slot); });
  std::vector<std::size_t> place;
  std::vector<LoadedParticle> kept;
  for (LoadedParticle const& p : loaded_) {
    place.push_back(kept.size());
    if (is_local(own, p.slot)) kept.push_back(p);
  }
  for (LoadOnBody& load : loads_) {
    std::erase_if(load.items, [&](LoadItem const& item) { return !is_local(own, loaded_[item.place].slot); });
    for (LoadItem& item : load.items) item.place = place[item.place];
  }
  loaded_ = std::move(kept);
  place_of_slot_ = {};
}

void BodyBoundary::start(FieldRef const& v) const {
  PIOLA_EXPECTS(released_ >= 0);
  for (auto const& h : held_) {
    double const now = along(v, h, D_);
    for (int c = 0; c < D_; ++c) {
      double& v_c = value_at(v, h.slot, c);
      v_c = c == h.axis ? h.speed : v_c + (h.speed - now) * h.direction[c];
    }
  }
}

void BodyBoundary::add_direction(std::size_t particle, PrescribedAxis const& along) {
  Particle const& p = particles_[particle];
  PrescribedDirection h{};
  h.slot = p.of.slot;
  h.axis = axis_of(along.direction);
  h.at_rest = true;
  std::copy(along.direction.begin(), along.direction.end(), h.direction);
  h.mass = p.of.mass;
  h.multiplied = multiplied_;
  h.support = static_cast<std::int32_t>(p.rows[along.row].support);
  // It keeps its place only if nothing has moved it before, either.
  for (auto const& other : p.rows)
    if (dot(other.direction, along.direction) != 0 && (multiplied_ || !other.at_rest)) h.at_rest = false;
  if (h.axis >= 0) h.position = p.of.position[static_cast<std::size_t>(h.axis)];
  held_.push_back(h);
  origins_.push_back({particle, along});
}

/// The directions in which particles are held from `time` on.
void BodyBoundary::choose_directions(double time) {
  held_.clear();
  origins_.clear();
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    std::vector<std::size_t> lasting;
    std::vector<Direction> directions;
    for (std::size_t r = 0; r < particles_[k].rows.size(); ++r) {
      Row const& row = particles_[k].rows[r];
      if (has_ended(supports_[row.support].until, time)) continue;
      lasting.push_back(r);
      directions.push_back(row.direction);
    }
    for (PrescribedAxis along : hold_along(directions)) {
      along.row = lasting[along.row];
      for (std::size_t s = 0; s < along.count; ++s) along.of[s] = lasting[along.of[s]];
      add_direction(k, along);
    }
  }
}

void BodyBoundary::evaluate_rows(double time) {
  for (auto& p : particles_)
    for (auto& row : p.rows) {
      auto const& velocity = supports_[row.support].velocity;
      if (velocity && !is_steady(*velocity)) row.speed = speed_along(*velocity, row.direction, p.of.X, time);
    }
}

/// Speeds at the start and at the end of a step; `continues`: the start is where the last step ended.
void BodyBoundary::evaluate_speeds(bool continues) {
  auto const put = [&](double PrescribedDirection::*speed) {
    for (std::size_t k = 0; k < held_.size(); ++k) {
      auto const& rows = particles_[origins_[k].particle].rows;
      held_[k].*speed = origins_[k].along.speed([&](std::size_t row) { return rows[row].speed; });
    }
  };
  if (continues) {
    for (auto& h : held_) h.start_speed = h.speed;
  } else {
    evaluate_rows(begun_);
    put(&PrescribedDirection::start_speed);
  }
  evaluate_rows(ended_);
  put(&PrescribedDirection::speed);
}

/// For the undeformed face.
Direction BodyBoundary::acceleration(LoadOnBody const& load, LoadItem const& item, double time) {
  return load.steady ? item.steady : acceleration_by(load.value, item.normal, item.factor, item.X, time);
}

/// At an end of the step, turned with the face where the load follows it.
Direction BodyBoundary::acting(LoadOnBody const& load, LoadItem const& item, bool at_end) const {
  Direction const a = acceleration(load, item, at_end ? ended_ : begun_);
  if (!load.follows) return a;
  double const* const turn = loaded_[item.place].turn[at_end];
  Direction turned{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(D_); ++c)
    for (std::size_t d = 0; d < static_cast<std::size_t>(D_); ++d) turned[c] += turn[3 * c + d] * a[d];
  return turned;
}

/// Adds the loads that act in the step, as they are at one of its ends.
void BodyBoundary::add_loads(int side) {
  for (auto const& load : loads_) {
    if (has_ended(load.until, begun_)) continue;
    for (auto const& item : load.items) {
      Direction const a = acceleration(load, item, side == 0 ? begun_ : ended_);
      LoadedParticle& p = loaded_[item.place];
      double* const part = load.follows ? p.follower[side] : p.dead[side];
      for (std::size_t c = 0; c < 3; ++c) part[c] += a[c];
    }
  }
}

void BodyBoundary::evaluate_loads(bool continues) {
  for (auto& p : loaded_)
    for (auto* const part : {p.dead, p.follower})
      for (int c = 0; c < 3; ++c) {
        part[0][c] = continues ? part[1][c] : 0;
        part[1][c] = 0;
      }
  if (!continues) add_loads(0);
  add_loads(1);
  for (auto& p : loaded_) std::copy_n(&p.dead[0][0], 6, &p.acting[0][0]);  // unless a pass rotates follower loads
}

bool BodyBoundary::begin_step(FieldRef const& x, double time, double dt) {
  int released = 0;
  for (auto const& s : supports_) released += has_ended(s.until, time) ? 1 : 0;
  for (auto const& l : loads_) released += has_ended(l.until, time) ? 1 : 0;
  bool const changed = released != released_, continues = !changed && time == ended_;
  released_ = released;
  begun_ = time;
  ended_ = time + dt;
  if (changed) choose_directions(time);
  if (changed || !steady_supports_) evaluate_speeds(continues);
  if (changed || !steady_loads_) evaluate_loads(continues);
  note_places(x);
  return changed;
}

void BodyBoundary::note_places(FieldRef const& x) {
  held_start_.clear();
  for (auto const& h : held_) held_start_.push_back(point_at(x, h.slot, D_));
  if (!named_loads_) return;
  loaded_start_.clear();
  for (auto const& p : loaded_) loaded_start_.push_back(point_at(x, p.slot, D_));
}

void BodyBoundary::end_step(FieldRef const& x, DeferredGlobalSum& work) {
  PIOLA_EXPECTS(held_start_.size() == held_.size());
  PIOLA_EXPECTS(!named_loads_ || loaded_start_.size() == loaded_.size());
  exec::ReproducibleSum of_step;
  for (auto const& h : held_)
    if (is_local(own_, h.slot)) of_step += h.work;
  for (auto const& p : loaded_)
    if (is_local(own_, p.slot)) of_step += p.work;
  if (own_)
    work.add_part(of_step);
  else
    work.add(of_step.value());
  for (std::size_t k = 0; k < held_.size(); ++k) {
    PrescribedDirection const& h = held_[k];
    if (!is_local(own_, h.slot)) continue;
    auto const along_it = [&](double change) {
      double const p = h.mass * change;
      return Point{p * h.direction[0], p * h.direction[1], p * h.direction[2]};
    };
    auto const support = static_cast<std::size_t>(h.support);
    add_impulse(support, held_start_[k], along_it(h.at_start));
    add_impulse(support, point_at(x, h.slot, D_), along_it(h.at_end));
  }
  for (std::size_t l = 0; l < loads_.size(); ++l) {
    LoadOnBody const& load = loads_[l];
    if (load.name.empty() || has_ended(load.until, begun_)) continue;
    for (auto const& item : load.items) {
      LoadedParticle const& p = loaded_[item.place];
      if (!is_local(own_, p.slot)) continue;
      Point first = acting(load, item, false), second = acting(load, item, true);
      for (std::size_t c = 0; c < 3; ++c) {
        double const half = static_cast<int>(c) < D_ ? 0.5 * (ended_ - begun_) * p.mass : 0;
        first[c] *= half;
        second[c] *= half;
      }
      of_loads_[l].add(loaded_start_[item.place], first);
      of_loads_[l].add(point_at(x, p.slot, D_), second);
    }
  }
}

void BodyBoundary::remove_ended(FieldRef const& rate) const {
  for (auto const& load : loads_) {
    if (has_ended(load.until, begun_) || !has_ended(load.until, ended_)) continue;
    for (auto const& item : load.items) {
      Direction const a = acting(load, item, true);
      for (int c = 0; c < D_; ++c) value_at(rate, loaded_[item.place].slot, c) -= a[static_cast<std::size_t>(c)];
    }
  }
}

void BodyBoundary::add_resultants_to(Resultants& actions) const {
  PIOLA_EXPECTS(actions.supports.size() <= of_supports_.size());
  PIOLA_EXPECTS(actions.loads.size() >= of_loads_.size());
  std::vector<ImpulseSum> all(of_supports_);
  all.insert(all.end(), of_loads_.begin(), of_loads_.end());
  if (own_) comm::allreduce_sum(std::span(all));
  for (std::size_t k = 0; k < actions.supports.size(); ++k) actions.supports[k].add(all[k].value());
  for (std::size_t k = 0; k < of_loads_.size(); ++k) actions.loads[k].add(all[of_supports_.size() + k].value());
}

void BodyBoundary::reset_impulses() {
  of_supports_.assign(of_supports_.size(), {});
  of_loads_.assign(of_loads_.size(), {});
}

void BodyBoundary::damp(FieldRef const& v, Index last, double factor) const {
  PIOLA_EXPECTS(last >= first_kept_);
  std::vector<double> before;
  for (auto const& h : held_) before.push_back(along(v, h, D_));
  for (Index i = first_kept_; i < last; ++i)
    for (int c = 0; c < D_; ++c) value_at(v, i, c) *= factor;
  for (std::size_t k = 0; k < held_.size(); ++k)
    for (int c = 0; c < D_; ++c) value_at(v, held_[k].slot, c) += (1 - factor) * before[k] * held_[k].direction[c];
}

bool BodyBoundary::follows() const {
  return std::any_of(loads_.begin(), loads_.end(), [](auto const& l) { return l.follows && !l.items.empty(); });
}

}  // namespace piola
