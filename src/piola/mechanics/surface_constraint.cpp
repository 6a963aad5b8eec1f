// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/surface_constraint.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/mechanics/constraint_matrix.hpp"
#include <algorithm>
#include <tuple>

namespace piola {
namespace {

/// The direction of the largest extent of the places: in this order rows are next to those with common particles.
std::size_t longest_extent(std::vector<ConstrainedFacet> const& places) {
  Direction low = places.front().X, high = low;
  for (auto const& place : places)
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], place.X[c]);
      high[c] = std::max(high[c], place.X[c]);
    }
  std::size_t longest = 0;
  for (std::size_t c = 1; c < 3; ++c)
    if (high[c] - low[c] > high[longest] - low[longest]) longest = c;
  return longest;
}

}  // namespace

SurfaceConstraint::SurfaceConstraint(int dimension, std::vector<Support> const& supports,
                                     std::vector<ConstrainedFacet> const& places, std::span<double const> mass,
                                     std::vector<Point> const& X)
    : D_(dimension), driven_(dimension, supports, {}, false) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  PIOLA_EXPECTS(places.empty() || mass.size() <= X.size());
  if (places.empty()) return;
  // Numbered in the order of the places, independent of the memory order: sums are taken in this order.
  std::vector<std::size_t> number(mass.size(), mass.size());
  for (auto const& place : places)
    for (auto const& w : place.weights) {
      auto const slot = static_cast<std::size_t>(w.slot);
      if (number[slot] < mass.size()) continue;
      number[slot] = particles_.size();
      number_of_slot_.emplace_back(w.slot, particles_.size());
      particles_.push_back({w.slot, mass[slot], X[slot]});
    }
  std::sort(number_of_slot_.begin(), number_of_slot_.end());
  std::vector<ConstrainedFacet const*> order;
  for (auto const& place : places) order.push_back(&place);
  std::size_t const along = longest_extent(places);
  std::stable_sort(order.begin(), order.end(), [along](auto a, auto b) { return a->X[along] < b->X[along]; });
  for (ConstrainedFacet const* const place : order) {
    std::size_t const first = weights_.size();
    for (auto const& w : place->weights) weights_.push_back({number[static_cast<std::size_t>(w.slot)], w.weight});
    auto const at = driven_.add_particle({static_cast<Index>(places_.size()), place->X, 1, place->X});
    places_.push_back({place->X, first, weights_.size()});
    for (auto const s : place->supports)
      for (auto const& d : directions_of(supports[s], D_)) driven_.add_row(at, s, d);
  }
  for (std::size_t a = 0; a < particles_.size(); ++a) weights_.push_back({a, 1});
  for (Particle const& p : particles_) slots_.push_back(p.slot);
  place_coordinates_.resize(places_.size() * static_cast<std::size_t>(D_));
}

/// Replicates the values of all particles within reach of places. Collective if the body is distributed.
void SurfaceConstraint::complete(FieldRef const& field) const {
  if (own_) allgather_selected_slots(field, *own_, slots_, D_);
}

FieldRef SurfaceConstraint::places_at(FieldRef const& x) {
  complete(x);
  FieldRef at{};
  at.data = place_coordinates_.data();
  at.component_stride = 1;
  at.particle_stride = D_;
  for (std::size_t p = 0; p < places_.size(); ++p)
    for (int c = 0; c < D_; ++c) {
      double sum = 0;
      for (std::size_t k = places_[p].first; k < places_[p].last; ++k)
        sum += weights_[k].weight * value_at(x, particles_[weights_[k].particle].slot, c);
      value_at(at, static_cast<Index>(p), c) = sum;
    }
  return at;
}

void SurfaceConstraint::begin_step(FieldRef const& x, std::span<PrescribedDirection> particles, bool changed,
                                   double time, double dt) {
  if (empty()) return;
  bool const others = driven_.begin_step(places_at(x), time, dt);
  if (!others && !changed) return;
  make_rows(particles);
  matrix_ = constraint_matrix(rows_, weights_, particles_.size(), [&](std::size_t a) { return particles_[a].mass; });
}

std::size_t SurfaceConstraint::particle_in(Index slot) const {
  auto const at = std::lower_bound(number_of_slot_.begin(), number_of_slot_.end(), std::pair(slot, std::size_t{0}));
  return at != number_of_slot_.end() && at->first == slot ? at->second : particles_.size();
}

void SurfaceConstraint::make_rows(std::span<PrescribedDirection> particles) {
  rows_.clear();
  auto const direction_of = [](PrescribedDirection const& h) {
    return Point{h.direction[0], h.direction[1], h.direction[2]};
  };
  for (auto& h : driven_.held()) {
    Place const& place = places_[static_cast<std::size_t>(h.slot)];
    rows_.push_back({place.X, direction_of(h), place.first, place.last, &h, true});
  }
  std::size_t const own = weights_.size() - particles_.size();
  for (auto& h : particles) {
    std::size_t const a = particle_in(h.slot);
    if (a == particles_.size()) continue;
    rows_.push_back({particles_[a].X, direction_of(h), own + a, own + a + 1, &h, false});
  }
  if (rows_.empty()) return;
  std::vector<ConstrainedFacet> extent;
  for (Row const& row : rows_) extent.push_back({row.X});
  std::size_t const along = longest_extent(extent);
  std::stable_sort(rows_.begin(), rows_.end(), [along](Row const& a, Row const& b) {
    return std::tie(a.held->axis, a.X[along]) < std::tie(b.held->axis, b.X[along]);
  });
}

double SurfaceConstraint::value(Row const& row, FieldRef const& field) const {
  double sum = 0;
  for (int c = 0; c < D_; ++c) {
    double const part = row.direction[static_cast<std::size_t>(c)];
    if (part == 0) continue;
    for (std::size_t k = row.first; k < row.last; ++k)
      sum += part * weights_[k].weight * value_at(field, particles_[weights_[k].particle].slot, c);
  }
  return sum;
}

/// lambda that gives the places their wanted(row) of a field; particles have theirs.
template <class Of>
std::vector<double> SurfaceConstraint::solved(FieldRef const& field, Of const& wanted) const {
  complete(field);
  std::vector<double> lambda(rows_.size(), 0);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    if (!rows_[r].of_place) continue;
    lambda[r] = wanted(*rows_[r].held) - value(rows_[r], field);
  }
  matrix_.solve(lambda);
  return lambda;
}

/// Adds M^-1 C^T lambda.
void SurfaceConstraint::add(std::vector<double> const& lambda, FieldRef const& to) const {
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (int c = 0; c < D_; ++c) {
      double const part = lambda[r] * rows_[r].direction[static_cast<std::size_t>(c)];
      for (std::size_t k = rows_[r].first; part != 0 && k < rows_[r].last; ++k) {
        Particle const& p = particles_[weights_[k].particle];
        value_at(to, p.slot, c) += part * weights_[k].weight / p.mass;
      }
    }
}

void SurfaceConstraint::set_velocity(FieldRef const& v) const {
  if (rows_.empty()) return;
  add(solved(v, [](PrescribedDirection const& h) { return h.speed; }), v);
}

void SurfaceConstraint::kick_first(FieldRef const& v, FieldRef const& rate, double dt) {
  if (rows_.empty()) return;
  complete(v);
  for (Row& row : rows_) {
    if (!row.of_place) continue;
    double const now = value(row, v);
    row.held->mean_speed = 0.5 * (now + row.held->speed);
    row.held->at_start = 2 * (row.held->mean_speed - now) / dt;  // the acceleration that is wanted, for now
  }
  auto const lambda = solved(rate, [](PrescribedDirection const& h) { return h.at_start; });
  add(lambda, rate);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    PrescribedDirection& h = *rows_[r].held;
    double const change = 0.5 * dt * lambda[r] / h.mass;
    if (rows_[r].of_place) h.at_start = h.work = 0;
    h.at_start += change;
    h.work += h.mass * change * h.mean_speed;
  }
}

void SurfaceConstraint::kick_last(FieldRef const& v) {
  if (rows_.empty()) return;
  auto const lambda = solved(v, [](PrescribedDirection const& h) { return h.speed; });
  add(lambda, v);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    PrescribedDirection& h = *rows_[r].held;
    double const change = lambda[r] / h.mass;
    if (rows_[r].of_place) h.at_end = 0;
    h.at_end += change;
    h.work += h.mass * change * h.mean_speed;
  }
}

void SurfaceConstraint::end_step(FieldRef const& x, DeferredGlobalSum& work) {
  if (!empty()) driven_.end_step(places_at(x), work);
}

void SurfaceConstraint::keep_velocity(FieldRef const& x, FieldRef const& v, DeferredGlobalSum& work) {
  if (rows_.empty()) return;
  auto const lambda = solved(v, [](PrescribedDirection const& h) { return h.speed; });
  add(lambda, v);
  FieldRef const at = places_at(x);
  exec::ReproducibleSum of_rows;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    PrescribedDirection const& h = *rows_[r].held;
    Point impulse = rows_[r].direction;
    for (double& c : impulse) c *= lambda[r];
    auto const support = static_cast<std::size_t>(h.support);
    driven_.add_impulse(support, rows_[r].of_place ? point_at(at, h.slot, D_) : point_at(x, h.slot, D_), impulse);
    of_rows += lambda[r] * h.speed;
  }
  work.add(of_rows.value());
}

double SurfaceConstraint::square_of_held(FieldRef const& rate) const {
  if (rows_.empty()) return 0;
  complete(rate);
  std::vector<double> values, lambda;
  for (Row const& row : rows_) values.push_back(value(row, rate));
  lambda = values;
  matrix_.solve(lambda);
  exec::ReproducibleSum sum;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    sum += lambda[r] * values[r];
    if (!rows_[r].of_place) sum += -rows_[r].held->mass * values[r] * values[r];
  }
  return sum.value();
}

std::size_t SurfaceConstraint::bytes() const {
  return matrix_.bytes() + weights_.size() * sizeof(Weight) + rows_.size() * sizeof(Row) +
         particles_.size() * (sizeof(Particle) + sizeof(number_of_slot_.front())) + places_.size() * sizeof(Place) +
         place_coordinates_.size() * sizeof(double);
}

}  // namespace piola
