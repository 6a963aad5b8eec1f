// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/energy_descent.hpp"
#include "piola/base/contracts.hpp"
#include "piola/formulations/nodal/particle_vectors.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

/// Distance to the point where the curvature is measured, and the longest move of an iteration [spacings].
constexpr double probe = 1e-4, longest = 0.5;
/// Length of a move along a direction without positive curvature [spacings].
constexpr double downhill = 0.1;

}  // namespace

/// The accelerations of the present forces, without the parts that supports remove.
EnergyDescent::Vector EnergyDescent::free_accelerations() const {
  ParticleVectors const vectors(body_);
  BodyState& s = body_.state();
  vectors.put(vectors.values_of(s.a), s.v);
  body_.boundary().hold_at_rest(s);
  Vector free = vectors.values_of(s.v);
  vectors.put(Vector(free.size(), 0), s.v);
  return free;
}

/// The second derivative of the potential energy along the direction, from the forces at a `distance` along it, in
/// units of the direction.
double EnergyDescent::curvature(double time, double distance) {
  ParticleVectors const vectors(body_);
  BodyState& s = body_.state();
  backend_.keep(s);
  body_.boundary().begin_step(s, time, 0);
  Vector change = vectors.values_of(s.a);
  vectors.put_moved(vectors.values_of(s.x), distance, direction_);
  FailureSlot failure;
  BodyState trial = s;
  trial.failure = &failure;
  backend_.step(trial, 0);
  Vector const moved = vectors.values_of(s.a);
  vectors.each_number([&](std::size_t i) { change[i] = (change[i] - moved[i]) / distance; });
  backend_.restore(s);
  return vectors.product(change, direction_);
}

/// A step that moves the particles by `distance` along the direction: its first kick adds dt / 2 times the free
/// `accelerations`. The kinetic energy that the body gains between start and end is the fall of its potential energy
/// by the trapezoidal rule.
void EnergyDescent::move(double time, double dt, double distance, Vector const& accelerations) {
  ParticleVectors const vectors(body_);
  BodyState& s = body_.state();
  Vector velocity(accelerations.size());
  vectors.each_number(
      [&](std::size_t i) { velocity[i] = distance / dt * direction_[i] - 0.5 * dt * accelerations[i]; });
  vectors.put(velocity, s.v);
  body_.set_damping_loss(body_.damping_loss() - body_.kinetic_energy());
  restarts_ = body_.step(backend_, time, dt) > 0;  // halved steps leave the line
  body_.damp(0);
}

Descent EnergyDescent::iterate(double time, double dt) {
  PIOLA_EXPECTS(dt > 0);
  ParticleVectors const vectors(body_);
  Vector const before = free_accelerations();
  double const square = vectors.product(before, before);
  if (restarts_ || !(vectors.product(before, direction_) > 0)) direction_ = before;
  restarts_ = false;
  double const slope = vectors.product(before, direction_), most = global_max_norm(body_, direction_);
  double const loss = body_.damping_loss();
  double distance = 0;  // if no force acts yet
  if (most > 0) {
    auto const& spacing = body_.body().spacing;
    double const unit = *std::min_element(spacing.begin(), spacing.begin() + body_.state().dimension) / most;
    double const stiffness = curvature(time, probe * unit);
    distance = std::min(stiffness > 0 ? slope / stiffness : downhill * unit, longest * unit);
  }
  move(time, dt, distance, before);
  Vector const after = free_accelerations();
  double const released = body_.damping_loss() - loss;
  bool const restarts = restarts_ || released < 0 || !(square > 0);
  double const beta =
      restarts ? 0 : std::max(0.0, (vectors.product(after, after) - vectors.product(after, before)) / square);
  vectors.each_number([&](std::size_t i) { direction_[i] = after[i] + (beta > 0 ? beta * direction_[i] : 0); });
  return {.unbalanced = std::sqrt(square), .released = released};
}

std::vector<double> EnergyDescent::state() const {
  Vector none(size_of_mode(body_), 0);
  return with_mode(body_, {}, direction_.empty() ? none : direction_);
}

void EnergyDescent::load(StateReader& reader, std::string const& name) {
  std::vector<double> all = state();
  reader.get_on_root(name, all);
  direction_.resize(size_of_mode(body_));
  without_mode(body_, 0, all, direction_);
  restarts_ = false;
}

}  // namespace piola::nodal
