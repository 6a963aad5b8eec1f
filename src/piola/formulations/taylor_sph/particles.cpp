// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/taylor_sph/particles.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/mechanics/prescribed.hpp"
#include "piola/particles/ordering.hpp"
#include <algorithm>

namespace piola::taylor_sph {

Particles::Particles(Assembly const& assembly, std::size_t body, Options const& options)
    : body_(assembly.particles.bodies[body]), moving_(options.moving), fields_(assembly.particles.dimension) {
  auto const& set = assembly.particles;
  X_.assign(set.X.begin() + body_.first, set.X.begin() + body_.last);
  kernel_volume_.assign(set.kernel_volume.begin() + body_.first, set.kernel_volume.begin() + body_.last);
  if (options.adjoint) kernel_volume_ = std::vector<double>(X_.size(), kernel_volume_.front());
  start_.resize(X_.size());
  for (Index i = 0; i < count(); ++i)
    for (std::size_t c = 0; c < at(dimension()); ++c) {
      auto const& u = assembly.initial_displacement;
      start_[at(i)][c] = X_[at(i)][c] + (u.empty() ? 0 : u[static_cast<std::size_t>(body_.first + i)][c]);
    }
}

void Particles::arrange(std::vector<Index> const& on_boundary) {
  std::vector<bool> outer(X_.size());
  for (Index const i : on_boundary) outer[at(i)] = true;
  boundary_count_ = static_cast<Index>(on_boundary.size());
  interior_ = {0, aligned(count() - boundary_count_)};
  boundary_ = {interior_.last, interior_.last + aligned(boundary_count_)};
  slot_of_.assign(X_.size(), 0);
  particle_in_.assign(at(boundary_.last), -1);
  id_in_slot_.assign(at(boundary_.last), SlotOrder::no_particle);
  auto const put = [&](Index slot, Index i) {
    slot_of_[at(i)] = slot;
    particle_in_[at(slot)] = i;
    id_in_slot_[at(slot)] = body_.first + i;
  };
  Index slot = 0;
  for (Index i = 0; i < count(); ++i)
    if (!outer[at(i)]) put(slot++, i);
  slot = boundary_.first;
  for (Index const i : on_boundary) put(slot++, i);
  fields_.allocate(boundary_.last);
  for (Index i = 0; i < count(); ++i) fields_.mass.at(slot_of_[at(i)]) = mass_[at(i)];
}

void Particles::set_initial_state(Assembly const& assembly) {
  for (Index i = 0; i < count(); ++i) {
    Index const slot = this->slot(i);
    auto const id = static_cast<std::size_t>(body_.first + i);
    for (int c = 0; c < dimension(); ++c) {
      auto const k = static_cast<std::size_t>(c);
      fields_.x.at(slot, c) = start_[at(i)][k];
      fields_.v.at(slot, c) = assembly.initial_velocity.empty() ? 0 : assembly.initial_velocity[id][k];
      fields_.drift.at(slot, c) = fields_.v.at(slot, c);
    }
    fields_.kernel_volume.at(slot) = kernel_volume_[at(i)];
  }
}

void Particles::set_views(BodyState& state) {
  state.dimension = dimension();
  state.interior = interior_;
  state.boundary = boundary_;
  state.boundary_count = boundary_count_;
  state.interior_count = count() - boundary_count_;
  fields_.set_views(state);
}

Particles::Point Particles::x(Index i) const { return point_at(fields_.x.ref(), slot(i), dimension()); }

Particles::Point Particles::v(Index i) const { return point_at(fields_.v.ref(), slot(i), dimension()); }

Particles::Point Particles::displacement(Index i) const {
  if (!moving_) return point_at(fields_.displacement.ref(), slot(i), dimension());
  Point u = x(i);
  for (std::size_t c = 0; c < 3; ++c) u[c] -= X_[at(i)][c];
  return u;
}

Particles::Point Particles::place(Index i) const {
  Point x = displacement(i);
  for (std::size_t c = 0; c < 3; ++c) x[c] += X_[at(i)][c];
  return x;
}

Particles::Point Particles::drifted(Index i, double time) const {
  Point r = x(i);
  for (int c = 0; c < dimension(); ++c) r[static_cast<std::size_t>(c)] += time * fields_.drift.at(slot(i), c);
  return r;
}

Points Particles::positions() const {
  Points r(X_.size());
  for (Index i = 0; i < count(); ++i) r[at(i)] = x(i);
  return r;
}

std::array<double, 6> Particles::stress_components(Index i) const {
  std::array<double, 6> r{};
  for (int c = 0; c < fields_.stress.components(); ++c) r[static_cast<std::size_t>(c)] = fields_.stress.at(slot(i), c);
  return r;
}

SymMat<3> Particles::stress(Index i) const {
  auto const own = stress_components(i);
  SymMat<3> s{};
  if (dimension() == 1) s(0, 0) = own[0];
  if (dimension() == 2) {
    s(0, 0) = own[0];
    s(1, 1) = own[1];
    s(0, 1) = own[2];
    s(2, 2) = fields_.out_of_plane.at(slot(i));
  }
  if (dimension() == 3) std::copy(own.begin(), own.end(), s.c);
  return s;
}

double Particles::volume_ratio(Index i) const { return fields_.kernel_volume.at(slot(i)) / kernel_volume_[at(i)]; }

double Particles::kinetic_energy() const {
  return exec_host::parallel_sum(count(), [&](Index i) {
    auto const velocity = v(i);
    return 0.5 * mass_[at(i)] * dot(velocity, velocity);
  });
}

void Particles::add_velocity(Index i, Point const& change) {
  for (int c = 0; c < dimension(); ++c) fields_.v.at(slot(i), c) += change[static_cast<std::size_t>(c)];
}

void Particles::scale_velocities(double factor) {
  for (Index i = 0; i < count(); ++i)
    for (int c = 0; c < dimension(); ++c) {
      fields_.v.at(slot(i), c) *= factor;
      fields_.drift.at(slot(i), c) *= factor;
    }
}

std::size_t Particles::bytes() const {
  return fields_.bytes() + sizeof(Index) * (slot_of_.size() + particle_in_.size()) +
         sizeof(std::int64_t) * id_in_slot_.size();
}

}  // namespace piola::taylor_sph
