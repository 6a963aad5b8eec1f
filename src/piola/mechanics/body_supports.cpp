// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/body_supports.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <map>

namespace piola {
namespace {

int axis_of(Direction const& d) {
  for (int c = 0; c < 3; ++c)
    if (d[static_cast<std::size_t>(c)] == 1) return c;
  return -1;
}

}  // namespace

double along(FieldRef const& field, PrescribedDirection const& h, int D) {
  double sum = 0;
  for (int c = 0; c < D; ++c) sum += h.direction[c] * value_at(field, h.slot, c);
  return sum;
}

BodySupports::BodySupports(int dimension, std::vector<Support> const& supports, bool multiplied)
    : D_(dimension), multiplied_(multiplied), impulses_(supports.size()) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  for (Support const& support : supports) {
    supports_.push_back(support);
    supports_.back().particles.clear();
    if (support.velocity && !is_steady(*support.velocity)) steady_ = false;
  }
}

std::size_t BodySupports::add_particle(PrescribedParticle const& particle) {
  PIOLA_EXPECTS(particle.slot >= 0);
  particles_.push_back({particle, {}});
  return particles_.size() - 1;
}

void BodySupports::add_row(std::size_t particle, std::size_t support, Direction const& direction) {
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

void BodySupports::add_supports(std::vector<Support> const& supports, std::function<bool(std::int64_t id)> const& takes,
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

void BodySupports::keep(Range own) {
  PIOLA_EXPECTS(!multiplied_);
  std::erase_if(particles_, [&](Particle const& p) { return !is_local(own, p.of.slot); });
}

int BodySupports::ended(double time) const {
  int count = 0;
  for (auto const& s : supports_) count += has_ended(s.until, time) ? 1 : 0;
  return count;
}

void BodySupports::start(FieldRef const& v) const {
  for (auto const& h : held_) {
    double const now = along(v, h, D_);
    for (int c = 0; c < D_; ++c) {
      double& v_c = value_at(v, h.slot, c);
      v_c = c == h.axis ? h.speed : v_c + (h.speed - now) * h.direction[c];
    }
  }
}

void BodySupports::add_direction(std::size_t particle, PrescribedAxis const& along) {
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
void BodySupports::choose_directions(double time) {
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

void BodySupports::evaluate_rows(double time) {
  for (auto& p : particles_)
    for (auto& row : p.rows) {
      auto const& velocity = supports_[row.support].velocity;
      if (velocity && !is_steady(*velocity)) row.speed = speed_along(*velocity, row.direction, p.of.X, time);
    }
}

/// Speeds at the start and at the end of a step; `continues`: the start is where the last step ended.
void BodySupports::evaluate_speeds(double time, double end_time, bool continues) {
  auto const put = [&](double PrescribedDirection::*speed) {
    for (std::size_t k = 0; k < held_.size(); ++k) {
      auto const& rows = particles_[origins_[k].particle].rows;
      held_[k].*speed = origins_[k].along.speed([&](std::size_t row) { return rows[row].speed; });
    }
  };
  if (continues) {
    for (auto& h : held_) h.start_speed = h.speed;
  } else {
    evaluate_rows(time);
    put(&PrescribedDirection::start_speed);
  }
  evaluate_rows(end_time);
  put(&PrescribedDirection::speed);
}

void BodySupports::begin_step(FieldRef const& x, double time, double end_time, bool changed, bool continues) {
  if (changed) choose_directions(time);
  if (changed || !steady_) evaluate_speeds(time, end_time, continues);
  held_start_.clear();
  for (auto const& h : held_) held_start_.push_back(point_at(x, h.slot, D_));
}

void BodySupports::end_step(FieldRef const& x, std::optional<Range> const& own) {
  PIOLA_EXPECTS(held_start_.size() == held_.size());
  for (std::size_t k = 0; k < held_.size(); ++k) {
    PrescribedDirection const& h = held_[k];
    if (!is_local(own, h.slot)) continue;
    auto const along_it = [&](double change) {
      double const p = h.mass * change;
      return Point{p * h.direction[0], p * h.direction[1], p * h.direction[2]};
    };
    ImpulseSum& sum = impulses_[static_cast<std::size_t>(h.support)];
    sum.add(held_start_[k], along_it(h.at_start));
    sum.add(point_at(x, h.slot, D_), along_it(h.at_end));
  }
}

void BodySupports::damp(FieldRef const& v, Index first, Index last, double factor) const {
  PIOLA_EXPECTS(last >= first);
  std::vector<double> before;
  for (auto const& h : held_) before.push_back(along(v, h, D_));
  for (Index i = first; i < last; ++i)
    for (int c = 0; c < D_; ++c) value_at(v, i, c) *= factor;
  for (std::size_t k = 0; k < held_.size(); ++k)
    for (int c = 0; c < D_; ++c) value_at(v, held_[k].slot, c) += (1 - factor) * before[k] * held_[k].direction[c];
}

}  // namespace piola
