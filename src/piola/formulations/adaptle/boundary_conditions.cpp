// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/boundary_conditions.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include <algorithm>
#include <array>

namespace piola::adaptle {
namespace {

/// Acceleration of particle k of a load [m/s2].
Direction load_on(Load const& load, std::size_t k, Direction const& X, double time) {
  return acceleration_by(load.value, load.pressure ? std::optional(load.normal_of(k)) : std::nullopt, load.factor[k], X,
                         time);
}

}  // namespace

BoundaryConditions::BoundaryConditions(Assembly const& assembly, System& system)
    : system_(system),
      supports_(assembly.supports),
      loads_(assembly.loads),
      shapes_(assembly.rigid_shapes, system),
      resultants_(assembly.supports, assembly.loads, assembly.rigid_shapes) {
  std::size_t const n = 3 * at(system.particles);
  if (!supports_.empty()) {
    held_ = LazyZeroArray<std::int8_t>(n);
    held_velocity_ = LazyZeroArray<double>(n);
    holder_ = LazyZeroArray<std::size_t>(n);
    reaction_ = LazyZeroArray<double>(n);
    system.boundary.reaction = reaction_.data();
    system.boundary.held = held_.data();
    system.boundary.held_velocity = held_velocity_.data();
  }
  if (!loads_.empty()) {
    load_ = LazyZeroArray<double>(n);
    system.boundary.load = load_.data();
  }
}

void BoundaryConditions::begin_step(double time, double dt) {
  if (!supports_.empty()) evaluate_supports(time + dt);
  if (!loads_.empty()) evaluate_loads(time + 0.5 * dt);
  shapes_.move(time, dt);
}

void BoundaryConditions::evaluate_supports(double time) {
  for (Range const& own : system_.local())
    std::fill(held_.begin() + std::ptrdiff_t{3} * own.first, held_.begin() + std::ptrdiff_t{3} * own.last, 0);
  for (std::size_t number = 0; number < supports_.size(); ++number) {
    Support const& support = supports_[number];
    if (has_ended(support.until, time)) continue;
    for (auto const id : support.particles) {
      auto const slot = static_cast<Index>(id);
      if (!system_.is_local(slot)) continue;
      for (std::size_t c = 0; c < at(system_.dimension); ++c) {
        if (!support.fix[c]) continue;
        std::size_t const k = 3 * at(id) + c;
        held_[k] = 1;
        holder_[k] = number;
        held_velocity_[k] = support.velocity ? (*support.velocity)[c](system_.reference_position(slot), time) : 0;
      }
    }
  }
}

void BoundaryConditions::evaluate_loads(double time) {
  for (Range const& own : system_.local())
    std::fill(load_.begin() + std::ptrdiff_t{3} * own.first, load_.begin() + std::ptrdiff_t{3} * own.last, 0);
  for (Load const& load : loads_) {
    if (has_ended(load.until, time)) continue;
    for (std::size_t k = 0; k < load.particles.size(); ++k) {
      auto const slot = static_cast<Index>(load.particles[k]);
      if (!system_.is_local(slot)) continue;
      auto const a = load_on(load, k, system_.reference_position(slot), time);
      for (std::size_t c = 0; c < at(system_.dimension); ++c) load_[3 * at(slot) + c] += a[c];
    }
  }
}

bool BoundaryConditions::holds(Index slot, int c) const { return !held_.empty() && held_[3 * at(slot) + at(c)] != 0; }

/// The forces of half time, at the positions of half time, act for the whole step.
std::vector<ImpulseSum> BoundaryConditions::impulses(double time, double dt) const {
  std::vector<ImpulseSum> sums(supports_.size() + loads_.size());
  auto const place = [&](std::size_t slot) {
    double const* const x = system_.position + 3 * slot;
    return std::array{x[0], x[1], x[2]};
  };
  for (std::size_t s = 0; s < supports_.size(); ++s)
    for (auto const particle : supports_[s].particles) {
      std::size_t const slot = at(particle);
      if (!system_.is_local(static_cast<Index>(particle))) continue;
      std::array<double, 3> impulse{};
      for (std::size_t c = 0; c < 3; ++c)
        if (holder_[3 * slot + c] == s) impulse[c] = dt * reaction_[3 * slot + c];
      sums[s].add(place(slot), impulse);
    }
  for (std::size_t l = 0; l < loads_.size(); ++l) {
    if (loads_[l].name.empty() || has_ended(loads_[l].until, time + 0.5 * dt)) continue;
    for (std::size_t k = 0; k < loads_[l].particles.size(); ++k) {
      auto const slot = static_cast<Index>(loads_[l].particles[k]);
      if (!system_.is_local(slot)) continue;
      Direction const a = load_on(loads_[l], k, system_.reference_position(slot), time + 0.5 * dt);
      std::array<double, 3> impulse{};
      for (std::size_t c = 0; c < at(system_.dimension); ++c)
        impulse[c] = dt * value_at(system_.field.mass, slot) * a[c];
      sums[supports_.size() + l].add(place(at(slot)), impulse);
    }
  }
  return sums;
}

void BoundaryConditions::end_step(double time, double dt) {
  resultants_.begin(dt);
  unreduced_.emplace(Unreduced{dt, impulses(time, dt), shapes_.actions()});
  for (std::size_t k = 0; k < shapes_.count(); ++k) resultants_.rigid_about[k] = shapes_.centre_at_half_time(k);
  if (system_.shared) return;
  resultants_ = resultants();
  unreduced_.reset();
}

Resultants BoundaryConditions::resultants() const {
  Resultants all = resultants_;
  if (!unreduced_) return all;
  auto [dt, impulses, rigids] = *unreduced_;
  if (system_.shared) {
    comm::allreduce_sum(std::span(impulses));
    comm::allreduce_sum(std::span(rigids));
  }
  for (std::size_t s = 0; s < supports_.size(); ++s) all.supports[s].add(impulses[s].value());
  for (std::size_t l = 0; l < loads_.size(); ++l) all.loads[l].add(impulses[supports_.size() + l].value());
  for (std::size_t k = 0; k < shapes_.count(); ++k) {
    exec::ReproducibleSums<6> const& sum = rigids[k];
    all.rigids[k].add({{dt * sum.value(0), dt * sum.value(1), dt * sum.value(2)},
                       {dt * sum.value(3), dt * sum.value(4), dt * sum.value(5)}});
  }
  return all;
}

}  // namespace piola::adaptle
