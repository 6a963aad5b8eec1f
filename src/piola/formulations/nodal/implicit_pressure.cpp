// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/implicit_pressure.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/nodal/particle_vectors.hpp"
#include <fmt/format.h>

namespace piola::nodal {
namespace {

/// Largest residual relative to the right side, in the norm of the preconditioner: larger ones spoil the energy. The
/// first pass only improves the midpoint.
constexpr double tolerance = 1e-4, tolerance_of_first = 1e-2;
constexpr int most_iterations = 400;
/// Passes end when one takes this many iterations or fewer.
constexpr int most_passes = 6, few_iterations = 3;

NodalBody& checked(NodalBody& body) {
  Problems problems;
  auto const refuse = [&](std::string_view what) {
    problems.add({}, fmt::format("body '{}': pressure = \"implicit\" is not for {} - take pressure = \"explicit\"",
                                 body.body().name, what));
  };
  if (body.shared()) refuse("runs on several ranks");
  if (!body.images().empty()) refuse("bodies with mirror planes");
  if (body.state().boundary.surface != nullptr)
    refuse("supports that hold the surface (allowed: hold = \"particles\")");
  problems.raise_if_any();
  return body;
}

}  // namespace

ImplicitPressure::ImplicitPressure(NodalBody& body, Backend const& backend)
    : body_(checked(body)), backend_(backend), preconditioner_(body, backend.lanes) {}

ImplicitPressure::Vector ImplicitPressure::ratios() const {
  Vector all(static_cast<std::size_t>(body_.particles()));
  for (Index a = 0; a < body_.particles(); ++a) all[static_cast<std::size_t>(a)] = value_at(body_.state().ratio, a, 0);
  return all;
}

ImplicitPressure::Vector ImplicitPressure::change_of_ratio(Vector const& by) {
  ParticleVectors(body_).put(by, body_.state().x);
  backend_.change_of_ratio(body_.state());
  return ratios();
}

/// Sets the accelerations of the body to those by the pressures.
void ImplicitPressure::accelerate(Vector const& pressure) {
  BodyState& s = body_.state();
  for (Index a = 0; a < body_.particles(); ++a) value_at(s.ratio, a, 0) = pressure[static_cast<std::size_t>(a)];
  backend_.accelerate_by_pressure(s);
}

/// The accelerations by the pressures, without the components that supports hold.
ImplicitPressure::Vector ImplicitPressure::free_accelerations(Vector const& pressure) {
  BodyState& s = body_.state();
  accelerate(pressure);
  body_.boundary().remove_held(s.a);
  return ParticleVectors(body_).values_of(s.a);
}

ImplicitPressure::Vector ImplicitPressure::apply(Vector const& pressure) {
  Vector result = change_of_ratio(free_accelerations(pressure));
  for (Index a = 0; a < body_.particles(); ++a) {
    auto const k = static_cast<std::size_t>(a);
    result[k] = pressure[k] / body_.material(a).constants.kappa - tau_ * result[k];
  }
  return result;
}

/// sum V u w, in which the matrix is symmetric.
double ImplicitPressure::product(Vector const& u, Vector const& w) const {
  return sum_over_slots(false, body_.own(), [&](Index a) {
    auto const k = static_cast<std::size_t>(a);
    return body_.volume(a) * u[k] * w[k];
  });
}

/// Conjugate gradients from the given pressure. Returns whether they have converged.
bool ImplicitPressure::solve(Vector const& wanted, double accuracy, Vector& pressure) {
  Vector r = apply(pressure), z, direction;
  for (std::size_t k = 0; k < r.size(); ++k) r[k] = wanted[k] - r[k];
  if (!(scale_ > 0)) {
    preconditioner_.solve(wanted, z);
    scale_ = product(wanted, z);
  }
  double const aim = accuracy * accuracy * scale_;
  preconditioner_.solve(r, z);
  direction = z;
  double square = product(r, z);
  for (iterations_ = 0; iterations_ < most_iterations && square > aim; ++iterations_) {
    Vector const q = apply(direction);
    double const length = square / product(direction, q);
    for (std::size_t k = 0; k < r.size(); ++k) {
      pressure[k] += length * direction[k];
      r[k] -= length * q[k];
    }
    preconditioner_.solve(r, z);
    double const next = product(r, z);
    for (std::size_t k = 0; k < r.size(); ++k) direction[k] = z[k] + next / square * direction[k];
    square = next;
  }
  return square <= aim;
}

/// Solves for the pressures of a step from x. by_velocity: dt/2 v [m]. A pass takes D at the midpoint that the pass
/// before has found, the first pass at one predicted from the accelerations of the last two steps. Returns whether the
/// iterations have converged.
bool ImplicitPressure::solve_step(Vector const& x, Vector const& by_velocity, Vector& pressure) {
  ParticleVectors const vectors(body_);
  BodyState& s = body_.state();
  Vector acceleration(x.size()), middle(x.size());
  vectors.each_particle([&](Index i) {
    for (int c = 0; c < s.dimension; ++c)
      acceleration[vectors.place(i, c)] = 2 * value_at(s.bulk_a, i, c) - value_at(s.bulk_a, i, s.dimension + c);
    pressure[static_cast<std::size_t>(i)] = 2 * value_at(s.pressure, i, 0) - value_at(s.pressure, i, 1);
  });
  backend_.linearise_pressure(s);
  Vector const before = ratios();
  scale_ = 0;
  bool converged = true;
  for (int pass = 0; converged && pass < most_passes && (pass < 2 || iterations_ > few_iterations); ++pass) {
    if (pass > 0) acceleration = free_accelerations(pressure);
    for (std::size_t k = 0; k < x.size(); ++k) middle[k] = x[k] + by_velocity[k] + tau_ * acceleration[k];
    vectors.put(middle, s.x);
    backend_.linearise_pressure(s);
    Vector wanted = change_of_ratio(by_velocity);
    for (std::size_t k = 0; k < wanted.size(); ++k) wanted[k] += before[k] - 1;
    converged = solve(wanted, pass == 0 ? tolerance_of_first : tolerance, pressure);
  }
  return converged;
}

/// Stores the pressures and accelerations as those of the last step.
void ImplicitPressure::keep(Vector const& pressure, Vector const& a) {
  ParticleVectors const vectors(body_);
  BodyState& s = body_.state();
  vectors.each_particle([&](Index i) {
    for (int c = 0; c < s.dimension; ++c) {
      value_at(s.bulk_a, i, s.dimension + c) = value_at(s.bulk_a, i, c);
      value_at(s.bulk_a, i, c) = a[vectors.place(i, c)];
    }
    value_at(s.pressure, i, 1) = value_at(s.pressure, i, 0);
    value_at(s.pressure, i, 0) = pressure[static_cast<std::size_t>(i)];
  });
}

void ImplicitPressure::move(double dt) {
  PIOLA_EXPECTS(dt > 0);
  ParticleVectors const vectors(body_);
  BodyState& s = body_.state();
  tau_ = 0.25 * dt * dt;
  preconditioner_.prepare(tau_);
  Vector const x = vectors.values_of(s.x), v = vectors.values_of(s.v);
  Vector by_velocity(v.size()), pressure(static_cast<std::size_t>(body_.particles()));
  for (std::size_t k = 0; k < v.size(); ++k) by_velocity[k] = 0.5 * dt * v[k];
  bool const converged = solve_step(x, by_velocity, pressure);
  accelerate(pressure);
  body_.boundary().carry_held(s.a, dt);
  Vector const a = vectors.values_of(s.a);
  vectors.each_particle([&](Index i) {
    for (int c = 0; c < s.dimension; ++c) {
      std::size_t const k = vectors.place(i, c);
      value_at(s.mean_v, i, c) = v[k] + 0.5 * dt * a[k];
      value_at(s.x, i, c) = x[k] + dt * v[k] + 0.5 * dt * dt * a[k];
      value_at(s.v, i, c) = v[k] + dt * a[k];
    }
  });
  if (converged)
    keep(pressure, a);
  else
    exec::record(s.failure, 0, not_converged);
}

}  // namespace piola::nodal
