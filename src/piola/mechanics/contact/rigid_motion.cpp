// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/rigid_motion.hpp"
#include "piola/base/contracts.hpp"
#include "piola/math/array_conversion.hpp"
#include "piola/mechanics/contact/state_vector.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace piola::contact {
namespace {

constexpr double widest_turn = 0.2;  // of a shape in a step [rad]
constexpr double resolved_of_shape =
    0.3;  // of 1/omega of a free shape: a light one bounces within a few steps of the bodies

Vec<3> value_at(std::array<Expression, 3> const& formulas, double time) {
  return {{formulas[0]({}, time), formulas[1]({}, time), formulas[2]({}, time)}};
}

}  // namespace

RigidMotion::RigidMotion(std::vector<RigidShape> const& shapes, int dimension, RigidPairs::Setting const& between,
                         std::vector<RigidSpring> springs)
    : dimension_(dimension), pairs_(shapes, dimension, between), springs_(std::move(springs), shapes) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  for (RigidShape const& given : shapes) {
    Shape shape{given, vector_of(given.axis), {}, {}, 0, value_at(given.angular_velocity, 0)};
    if (given.free) shape.body.emplace(given, dimension);
    any_ = any_ || given.turns();
    shapes_.push_back(std::move(shape));
  }
}

void RigidMotion::place(std::vector<RigidSurface>& surfaces) const {
  PIOLA_EXPECTS(surfaces.size() == shapes_.size());
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    Shape const& shape = shapes_[k];
    RigidSurface& surface = surfaces[k];
    if (!shape.given.turns()) continue;
    surface.turn = matrix_of(shape.body ? shape.body->turn : shape.turn);
    surface.axis = surface.turn * shape.axis;
    surface.angular_velocity = shape.body ? shape.body->angular_velocity() : shape.rate;
    if (!shape.body) continue;
    surface.centre = shape.body->centre;
    surface.velocity = shape.body->velocity;
    surface.inverse_mass = 1 / shape.body->mass();
    surface.inverse_inertia = shape.body->inverse_inertia();
  }
}

void RigidMotion::drive(Shape& shape, RigidSurface& surface, double time, double dt) const {
  surface.velocity = value_at(shape.given.velocity, time + dt);
  surface.centre = surface.centre + dt * value_at(shape.given.velocity, time + 0.5 * dt);
  if (!shape.given.turns()) return;
  Vec<3> const rate = value_at(shape.given.angular_velocity, time + 0.5 * dt);
  shape.rate = value_at(shape.given.angular_velocity, time + dt);
  if (dimension_ < 3) {
    shape.angle += dt * rate[2];
    shape.turn = turn_about({{0, 0, 1}}, shape.angle);
  } else {
    shape.turn = of_unit_length(turn_by(dt * rate) * shape.turn);
  }
}

void RigidMotion::move(std::vector<RigidSurface>& surfaces, double time, double dt) {
  PIOLA_EXPECTS(surfaces.size() == shapes_.size());
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    if (shapes_[k].body)
      shapes_[k].body->drift(dt);
    else
      drive(shapes_[k], surfaces[k], time, dt);
  }
  place(surfaces);
}

/// Bound over springs of shapes, contact between shapes, and contact with points of bodies.
void RigidMotion::bound_frequency(SurfaceContactSystem const& bodies) {
  std::vector<double> of_shapes;
  for (std::size_t k = 0; k < shapes_.size(); ++k) of_shapes.push_back(bodies.frequencies(k).of_shape);
  springs_.add_frequencies2(bodies.rigids(), of_shapes);
  frequency2_ = pairs_.frequency2(of_shapes);
  frequency2_ = std::max(frequency2_, springs_.frequency2(of_shapes));
  for (std::size_t k = 0; k < shapes_.size(); ++k)
    if (shapes_[k].body) frequency2_ = std::max(frequency2_, bodies.frequencies(k).of_points + of_shapes[k]);
  of_shapes_ = of_shapes.empty() ? 0 : *std::max_element(of_shapes.begin(), of_shapes.end());
}

void RigidMotion::start(SurfaceContactSystem const& bodies) {
  PIOLA_EXPECTS(bodies.rigids().size() == shapes_.size());
  pairs_.start(bodies.rigids());
  springs_.evaluate(bodies.rigids());
  bound_frequency(bodies);
}

void RigidMotion::evaluate(SurfaceContactSystem const& bodies, double dt) {
  PIOLA_EXPECTS(bodies.rigids().size() == shapes_.size());
  pairs_.evaluate(bodies.rigids(), dt);
  springs_.evaluate(bodies.rigids());
  bound_frequency(bodies);
}

RigidPairs::Load RigidMotion::on(SurfaceContactSystem const& bodies, std::size_t shape) const {
  PIOLA_EXPECTS(shape < shapes_.size());
  ForceMoment const by_bodies = bodies.resultant_on_rigid(shape);
  RigidPairs::Load const& by_shapes = pairs_.on(shape);
  return {by_bodies.force + by_shapes.force, by_bodies.moment + by_shapes.moment};
}

void RigidMotion::kick(SurfaceContactSystem& bodies, double time, double half) {
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    if (!shapes_[k].body) continue;
    RigidPairs::Load const load = on(bodies, k);
    work_ += shapes_[k].body->kick(half * load.force, half * load.moment);
    act(shapes_[k], time, half);
  }
  work_ += springs_.kick_by_springs(bodies.rigids(), free_bodies(), half);
  place(bodies.rigids());
}

/// Applies gravity, force and torque to a free shape.
void RigidMotion::act(Shape& shape, double time, double half) {
  RigidBody& body = *shape.body;
  RigidShape const& given = shape.given;
  Vec<3> const impulse = half * (body.mass() * value_at(given.gravity, time) + value_at(given.force, time));
  Vec<3> moment = half * value_at(given.torque, time);
  if (given.torque_axes == RigidShape::TorqueAxes::body) moment = matrix_of(body.turn) * moment;
  Vec<3> const before = body.velocity, rate = body.angular_velocity();
  work_ += body.kick(impulse, moment);
  work_ += 0.5 * (dot(impulse, before + body.velocity) + dot(moment, rate + body.angular_velocity()));
}

RigidSprings::BodyOf RigidMotion::free_bodies() {
  return [this](std::size_t k) { return shapes_[k].body ? &*shapes_[k].body : nullptr; };
}

void RigidMotion::kick_by_dashpots(SurfaceContactSystem& bodies, double half, bool backwards) {
  if (!springs_.any()) return;
  work_ += springs_.kick_by_dashpots(bodies.rigids(), free_bodies(), half, backwards);
  place(bodies.rigids());
}

void RigidMotion::damp(SurfaceContactSystem& bodies, double factor) {
  for (Shape& shape : shapes_) {
    if (!shape.body) continue;
    double const before = shape.body->moving_energy() + shape.body->turning_energy();
    shape.body->velocity = shape.body->velocity - (1 - factor) * shape.body->free_part(shape.body->velocity);
    shape.body->spin = factor * shape.body->spin;
    damping_loss_ += before - shape.body->moving_energy() - shape.body->turning_energy();
  }
  place(bodies.rigids());
}

double RigidMotion::contact_time_step(std::vector<RigidSurface> const& surfaces) const {
  double step = any_ ? pairs_.contact_time_step(surfaces) : std::numeric_limits<double>::infinity();
  if (of_shapes_ > 0) step = std::min(step, resolved_of_shape / std::sqrt(of_shapes_));
  for (RigidSurface const& surface : surfaces) {
    double const rate = std::sqrt(square_of(surface.angular_velocity));
    if (rate > 0) step = std::min(step, widest_turn / rate);
  }
  return step;
}

double RigidMotion::kinetic_energy() const {
  double sum = 0;
  for (Shape const& shape : shapes_)
    if (shape.body) sum += shape.body->moving_energy() + shape.body->turning_energy();
  return sum;
}

Vec<3> RigidMotion::linear_momentum() const {
  Vec<3> sum;
  for (Shape const& shape : shapes_)
    if (shape.body) sum = sum + shape.body->mass() * shape.body->velocity;
  return sum;
}

Vec<3> RigidMotion::angular_momentum() const {
  Vec<3> sum;
  for (Shape const& shape : shapes_)
    if (shape.body) sum = sum + shape.body->spin + shape.body->mass() * cross(shape.body->centre, shape.body->velocity);
  return sum;
}

std::vector<RigidState> RigidMotion::states(std::vector<RigidSurface> const& surfaces) const {
  PIOLA_EXPECTS(surfaces.size() == shapes_.size());
  std::vector<RigidState> all;
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    Shape const& shape = shapes_[k];
    if (!shape.given.turns()) continue;
    RigidState state;
    state.name = shape.given.name;
    state.centre = array_of(surfaces[k].centre);
    state.velocity = array_of(surfaces[k].velocity);
    state.angular_velocity = array_of(surfaces[k].angular_velocity);
    state.turn = dimension_ < 3 ? std::array<double, 3>{0, 0, shape.body ? shape.body->angle : shape.angle}
                                : array_of(rotation_vector(shape.body ? shape.body->turn : shape.turn));
    if (shape.body) {
      state.rotational_energy = shape.body->turning_energy();
      state.kinetic_energy = shape.body->moving_energy() + state.rotational_energy;
    }
    all.push_back(std::move(state));
  }
  return all;
}

std::vector<double> RigidMotion::state() const {
  std::vector<double> all{work_, damping_loss_, frequency2_, of_shapes_};
  for (Shape const& shape : shapes_) {
    Quaternion const& turn = shape.body ? shape.body->turn : shape.turn;
    all.push_back(shape.body ? shape.body->angle : shape.angle);
    all.push_back(turn.w);
    put(all, turn.v);
    for (Vec<3> const& v : shape.body ? std::array{shape.body->centre, shape.body->velocity, shape.body->spin}
                                      : std::array{Vec<3>{}, Vec<3>{}, shape.rate})
      put(all, v);
  }
  for (std::vector<double> const& part : {springs_.state(), pairs_.state()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

void RigidMotion::restore(std::vector<RigidSurface>& surfaces, std::vector<double> const& state) {
  StateVector from(state);
  for (double* number : {&work_, &damping_loss_, &frequency2_, &of_shapes_}) *number = from.next();
  for (Shape& shape : shapes_) {
    double& angle = shape.body ? shape.body->angle : shape.angle;
    Quaternion& turn = shape.body ? shape.body->turn : shape.turn;
    angle = from.next();
    turn.w = from.next();
    from.take(turn.v);
    std::array<Vec<3>, 3> motion;
    for (Vec<3>& v : motion) from.take(v);
    if (shape.body)
      std::tie(shape.body->centre, shape.body->velocity, shape.body->spin) = std::tie(motion[0], motion[1], motion[2]);
    else
      shape.rate = motion[2];
  }
  place(surfaces);
  springs_.restore(surfaces, from);
  pairs_.restore(surfaces, from.rest());
}

}  // namespace piola::contact
