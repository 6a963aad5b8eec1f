// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/rigid_springs.hpp"
#include "piola/base/contracts.hpp"
#include "piola/math/array_conversion.hpp"
#include "piola/mechanics/contact/state_vector.hpp"
#include <algorithm>
#include <cmath>

namespace piola::contact {
namespace {

/// Velocity of a free body per unit impulse at y, along n [1/kg].
double mobility_of(RigidBody const& body, Vec<3> const& y, Vec<3> const& n) {
  Vec<3> const turning = cross(y - body.centre, n);
  return dot(n, body.free_part(n)) / body.mass() + dot(turning, body.inverse_inertia() * turning);
}

}  // namespace

RigidSprings::RigidSprings(std::vector<RigidSpring> springs, std::vector<RigidShape> const& shapes)
    : springs_(std::move(springs)), now_(springs_.size()), impulses_(springs_.size()) {
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    std::array<Vec<3>, 2> arms;
    for (std::size_t end = 0; end < 2; ++end) {
      auto const shape = shape_of(s, end);
      PIOLA_EXPECTS(!shape || *shape < shapes.size());
      arms[end] = vector_of(springs_[s].points[end]);
      if (shape) arms[end] = arms[end] - vector_of(shapes[*shape].centre);
    }
    arms_.push_back(arms);
  }
}

Vec<3> RigidSprings::end_of(std::size_t spring, std::size_t end, std::vector<RigidSurface> const& shapes) const {
  Vec<3> const& arm = arms_[spring][end];
  auto const shape = shape_of(spring, end);
  return shape ? shapes[*shape].centre + shapes[*shape].turn * arm : arm;
}

void RigidSprings::evaluate(std::vector<RigidSurface> const& shapes) {
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    Now& now = now_[s];
    for (std::size_t end = 0; end < 2; ++end) now.ends[end] = end_of(s, end, shapes);
    Vec<3> const between = now.ends[1] - now.ends[0];
    now.length = std::sqrt(dot(between, between));
    now.along = now.length > 0 ? (1 / now.length) * between : Vec<3>{};
    now.tension = springs_[s].stiffness * (now.length - springs_[s].rest_length);
  }
}

void RigidSprings::add_frequencies2(std::vector<RigidSurface> const& shapes, std::vector<double>& of_shapes) const {
  for (std::size_t s = 0; s < springs_.size(); ++s)
    for (std::size_t end = 0; end < 2; ++end)
      if (auto const shape = shape_of(s, end))
        of_shapes[*shape] += springs_[s].stiffness * shapes[*shape].mobility(now_[s].ends[end]);
}

double RigidSprings::frequency2(std::vector<double> const& of_shapes) const {
  double largest = 0;
  for (RigidSpring const& spring : springs_)
    largest = std::max(largest, of_shapes[spring.first] + (spring.second ? of_shapes[*spring.second] : 0));
  return largest;
}

void RigidSprings::begin() { std::fill(impulses_.begin(), impulses_.end(), ForceMoment{}); }

/// Applies an impulse of tension [N s].
double RigidSprings::apply(std::size_t spring, double impulse, std::vector<RigidSurface> const& shapes,
                           BodyOf const& body_of) {
  double work = 0;
  Now const& now = now_[spring];
  for (std::size_t end = 0; end < 2; ++end) {
    auto const shape = shape_of(spring, end);
    Vec<3> const on = (end == 0 ? impulse : -impulse) * now.along;
    if (!shape) continue;
    if (RigidBody* const body = body_of(*shape))
      work += body->kick(on, cross(now.ends[end] - body->centre, on));
    else
      work -= dot(on, shapes[*shape].velocity_at(now.ends[end]));
  }
  Vec<3> const on_first = impulse * now.along;
  impulses_[spring] = {impulses_[spring].force + on_first, impulses_[spring].moment + cross(now.ends[0], on_first)};
  return work;
}

double RigidSprings::kick_by_springs(std::vector<RigidSurface> const& shapes, BodyOf const& body_of, double half) {
  double work = 0;
  for (std::size_t s = 0; s < springs_.size(); ++s) work += apply(s, half * now_[s].tension, shapes, body_of);
  return work;
}

double RigidSprings::kick_by_dashpots(std::vector<RigidSurface> const& shapes, BodyOf const& body_of, double half,
                                      bool backwards) {
  double work = 0;
  for (std::size_t k = 0; k < springs_.size(); ++k) {
    std::size_t const s = backwards ? springs_.size() - 1 - k : k;
    double const damping = springs_[s].damping;
    if (!(damping > 0)) continue;
    Now const& now = now_[s];
    double rate = 0, mobility = 0;  // of the length [m/s], [1/kg]
    for (std::size_t end = 0; end < 2; ++end) {
      auto const shape = shape_of(s, end);
      if (!shape) continue;
      RigidBody const* const body = body_of(*shape);
      Vec<3> const& y = now.ends[end];
      Vec<3> const v = body == nullptr ? shapes[*shape].velocity_at(y)
                                       : body->velocity + cross(body->angular_velocity(), y - body->centre);
      rate += (end == 0 ? -1 : 1) * dot(now.along, v);
      if (body != nullptr) mobility += mobility_of(*body, y, now.along);
    }
    double const decay = -std::expm1(-damping * mobility * half);  // part of the rate that is lost
    double const impulse = rate * (mobility > 0 ? decay / mobility : damping * half);
    loss_ += impulse * rate * (1 - 0.5 * decay);
    work += apply(s, impulse, shapes, body_of);
  }
  return work;
}

double RigidSprings::energy() const {
  double sum = 0;
  for (std::size_t s = 0; s < springs_.size(); ++s)
    sum += 0.5 * now_[s].tension * (now_[s].length - springs_[s].rest_length);
  return sum;
}

std::vector<double> RigidSprings::state() const {
  std::vector<double> all{loss_};
  for (ForceMoment const& impulse : impulses_) {
    put(all, impulse.force);
    put(all, impulse.moment);
  }
  return all;
}

void RigidSprings::restore(std::vector<RigidSurface> const& shapes, StateVector& from) {
  evaluate(shapes);
  loss_ = from.next();
  for (ForceMoment& impulse : impulses_) {
    from.take(impulse.force);
    from.take(impulse.moment);
  }
}

}  // namespace piola::contact
