// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/boundary_conditions.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/domain/communicator.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola::nodal {
namespace {

/// Positions for supports that hold the surface; empty if there are none.
std::vector<std::array<double, 3>> positions(Assembly const& assembly, Boundary::BodyInput const& of_body) {
  if (of_body.held.empty()) return {};
  SlotOrder const& order = of_body.order;
  std::vector<std::array<double, 3>> X(static_cast<std::size_t>(order.slots()));
  for (std::size_t i = 0; i < static_cast<std::size_t>(order.particles); ++i)
    X[i] = assembly.particles.X[static_cast<std::size_t>(order.id[i])];
  return X;
}

}  // namespace

Boundary::Boundary(Assembly const& assembly, std::size_t body, BodyInput const& of_body)
    : body_(assembly.particles.bodies[body]),
      D_(assembly.particles.dimension),
      driven_(D_, assembly.supports, assembly.loads, false),
      surface_(D_, assembly.supports, of_body.held, of_body.mass, positions(assembly, of_body)),
      absorbing_(
          D_,
          {assembly.loads, of_body.absorbing, [&](Index slot) { return of_body.mass[static_cast<std::size_t>(slot)]; },
           [&](Index slot) {
             return assembly.particles.X[static_cast<std::size_t>(of_body.order.id[static_cast<std::size_t>(slot)])];
           }}),
      own_(of_body.own) {
  PIOLA_EXPECTS(body < assembly.particles.bodies.size());
  std::vector<Index> slot_of(static_cast<std::size_t>(body_.last - body_.first));
  for (Index i = 0; i < of_body.order.particles; ++i)
    slot_of[static_cast<std::size_t>(of_body.order.id[static_cast<std::size_t>(i)] - body_.first)] = i;
  driven_.add_supports(
      assembly.supports, [&](std::int64_t id) { return id >= body_.first && id < body_.last; },
      [&](std::int64_t id) {
        Index const slot = slot_of[static_cast<std::size_t>(id - body_.first)];
        auto const& X = assembly.particles.X[static_cast<std::size_t>(id)];
        return BodyBoundary::PrescribedParticle{slot, X, of_body.mass[static_cast<std::size_t>(slot)], X};
      });
  take_loads(assembly, of_body, slot_of);
  refuse_held_beside_absorbing();
}

void Boundary::refuse_held_beside_absorbing() const {
  for (Index const slot : absorbing_.slots())
    if (surface_.reaches(slot))
      throw InputError(fmt::format(
          "body '{}': a support holds the surface beside a non-reflecting patch, where both act on the same particles "
          "(allowed: hold = \"particles\" there) - change hold",
          body_.name));
}

/// Supports that hold the surface, and non-reflecting patches, are solved for on every rank, including all held
/// particles near them.
void Boundary::distribute(Range own) {
  if (surface_.empty() && absorbing_.empty())
    driven_.keep(own);
  else
    driven_.share(own);
  surface_.share(own);
  absorbing_.share(own);
}

/// Acceleration per unit of the load's value, per slot; zero where it does not act.
LazyZeroArray<double> Boundary::factors(Load const& load, std::size_t number, BodyInput const& of_body,
                                        std::vector<Index> const& slot_of) const {
  LazyZeroArray<double> factor(of_body.mass.size());
  Range const own = of_body.slots();
  if (load.on_face()) {
    std::size_t const last = std::min(of_body.parts[number].size(), static_cast<std::size_t>(own.last));
    for (auto i = static_cast<std::size_t>(own.first); i < last; ++i)
      factor[i] = of_body.parts[number][i].area / of_body.mass[i];
    return factor;
  }
  for (std::size_t k = 0; k < load.particles.size(); ++k) {
    auto const id = load.particles[k];
    if (id >= body_.first && id < body_.last)
      factor[static_cast<std::size_t>(slot_of[static_cast<std::size_t>(id - body_.first)])] = load.factor[k];
  }
  return factor;
}

void Boundary::take_loads(Assembly const& assembly, BodyInput const& of_body, std::vector<Index> const& slot_of) {
  for (std::size_t number = 0; number < assembly.loads.size(); ++number) {
    Load const& load = assembly.loads[number];
    if (load.absorbs) continue;
    auto const factor = factors(load, number, of_body, slot_of);
    for (auto slot = static_cast<std::size_t>(of_body.slots().first);
         slot < static_cast<std::size_t>(of_body.slots().last); ++slot) {
      if (factor[slot] == 0) continue;
      driven_.add_load(number, {static_cast<Index>(slot), of_body.mass[slot], factor[slot],
                                assembly.particles.X[static_cast<std::size_t>(of_body.order.id[slot])],
                                load.pressure ? std::optional(of_body.parts[number][slot].normal) : std::nullopt});
    }
  }
  if (own_) distribute(*own_);
  double follows = driven_.follows() ? 1 : 0;  // ranks turn loads together
  if (own_) comm::allreduce_max(follows);
  follows_ = follows > 0;
  for (auto const& p : driven_.loaded()) {
    auto const own = of_body.centroid.begin() + std::ptrdiff_t{p.slot} * D_;
    centroid_.insert(centroid_.end(), own, own + D_);
    if (!assembly.particles.axisymmetric) continue;
    double const R =
        assembly.particles.X[static_cast<std::size_t>(of_body.order.id[static_cast<std::size_t>(p.slot)])][0];
    radius_.push_back(R > 1e-6 * body_.spacing[0] ? R : 0);
  }
}

void Boundary::attach(BodyState& state) {
  begin_step(state, 0, 0);
  driven_.start(state.v);
  surface_.set_velocity(state.v);
}

void Boundary::begin_step(BodyState& state, double time, double dt) {
  PIOLA_EXPECTS(dt >= 0);
  bool const changed = driven_.begin_step(state.x, time, dt);
  surface_.begin_step(state.x, driven_.held(), changed, time, dt);
  absorbing_.begin_step(driven_.held(),
                        {state.boundary.mirrored, static_cast<std::size_t>(state.boundary.mirrored_count)}, time, dt);
  state.boundary.absorbing = absorbing_.empty() ? nullptr : &absorbing_;
  state.boundary.absorb = [](AbsorbingSurface& surface, BodyState& body, double half, bool at_end) {
    surface.absorb({body.x, body.v, body.a}, half, at_end);
    if (!surface.converges()) exec::record(body.failure, surface.slots().front(), AbsorbingSurface::not_converged);
  };
  state.boundary.surface = surface_.empty() ? nullptr : &surface_;
  state.boundary.kick_surface = [](SurfaceConstraint& surface, BodyState& body, bool first, double step) {
    if (first)
      surface.kick_first(body.v, body.a, step);
    else
      surface.kick_last(body.v);
  };
  state.boundary.held = driven_.held().data();
  state.boundary.held_count = static_cast<Index>(driven_.held().size());
  state.boundary.loaded = driven_.loaded().data();
  state.boundary.loaded_count = static_cast<Index>(driven_.loaded().size());
  state.boundary.loaded_centroid = centroid_.data();
  state.boundary.loaded_radius = radius_.empty() ? nullptr : radius_.data();
  state.boundary.follows = follows_;
}

void Boundary::end_step(BodyState& state) {
  driven_.end_step(state.x, work_);
  surface_.end_step(state.x, work_);
  absorbing_.end_step(driven_, work_);
  driven_.remove_ended(state.a);
}

void Boundary::add_resultants_to(Resultants& actions) const {
  driven_.add_resultants_to(actions);
  surface_.add_resultants_to(actions);
}

void Boundary::damp(BodyState& state, double factor) const {
  driven_.damp(state.v, state.slots.last, factor);
  surface_.set_velocity(state.v);
}

void Boundary::remove_held(FieldRef const& field) {
  for (PrescribedDirection const& h : driven_.held()) {
    double const by = along(field, h, D_);
    for (int c = 0; c < D_; ++c) value_at(field, h.slot, c) -= by * h.direction[c];
  }
}

void Boundary::carry_held(FieldRef const& a, double dt) {
  for (PrescribedDirection& h : driven_.held()) {
    double const impulse = dt * along(a, h, D_);
    h.at_start -= impulse;
    h.work -= h.mass * impulse * h.mean_speed;
  }
  remove_held(a);
}

void Boundary::hold_at_rest(BodyState& state) {
  remove_held(state.v);
  surface_.set_velocity(state.v);
}

exec::ReproducibleSum Boundary::square_of_held(BodyState const& state) const {
  exec::ReproducibleSum sum;
  for (Index n = 0; n < state.boundary.held_count; ++n) {
    PrescribedDirection const& h = state.boundary.held[n];
    if (!is_local(own_, h.slot)) continue;
    double const a = along(state.a, h, D_);
    sum += h.mass * a * a;
  }
  return sum;
}

}  // namespace piola::nodal
