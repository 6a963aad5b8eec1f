// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/math/lanes.hpp"
#include "piola/particles/particle_set.hpp"
#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace piola {

/// Maps ids of a set to bodies and slots of a formulation with an order of its own.
class SlotsById {
 public:
  SlotsById() = default;
  /// Uses bodies[b]->particles() and ->id(slot).
  template <class Bodies>
  SlotsById(ParticleSet const& set, Bodies const& bodies) : body_(set.body), slot_(set.X.size()) {
    for (auto const& body : bodies)
      for (Index slot = 0; slot < body->particles(); ++slot) slot_[static_cast<std::size_t>(body->id(slot))] = slot;
  }

  /// Calls f(k, body, slot) for each ids[k].
  template <class F>
  void visit(std::span<std::int64_t const> ids, F const& f) const {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      auto const id = static_cast<std::size_t>(ids[k]);
      f(k, static_cast<std::size_t>(body_[id]), slot_[id]);
    }
  }
  /// As visit(), in a parallel loop: f may write only data of k.
  template <class F>
  void parallel_visit(std::span<std::int64_t const> ids, F const& f) const {
    exec_host::parallel_for(static_cast<Index>(ids.size()), [&](Index k) {
      auto const id = static_cast<std::size_t>(ids[static_cast<std::size_t>(k)]);
      f(static_cast<std::size_t>(k), static_cast<std::size_t>(body_[id]), slot_[id]);
    });
  }

 private:
  std::vector<int> body_;
  std::vector<Index> slot_;
};

/// Implementation of CoupledParticles. add_coupled_particles() is collective and
/// returns the values of all ids on all ranks. add_velocities_of() must be called with the same ids on all ranks;
/// changes of particles of other ranks have no effect.
template <class Bodies>
void add_coupled_particles(Bodies const& bodies, SlotsById const& slots, std::span<std::int64_t const> ids,
                           std::span<std::array<double, 3>> x, std::span<std::array<double, 3>> v) {
  PIOLA_EXPECTS(x.size() == ids.size() && v.size() == ids.size());
  std::vector<Range> own;
  for (auto const& body : bodies) own.push_back(body->own());
  slots.parallel_visit(ids, [&](std::size_t k, std::size_t body, Index slot) {
    bool const mine = slot >= own[body].first && slot < own[body].last;
    x[k] = mine ? bodies[body]->x(slot) : std::array<double, 3>{};
    v[k] = mine ? bodies[body]->v(slot) : std::array<double, 3>{};
  });
  if (!comm::is_parallel()) return;
  std::vector<std::array<double, 3>> both(x.begin(), x.end());
  both.insert(both.end(), v.begin(), v.end());
  static_assert(sizeof(both[0]) == 3 * sizeof(double));
  if (!both.empty()) comm::allreduce_or({both.front().data(), 3 * both.size()});
  auto const middle = both.begin() + static_cast<std::ptrdiff_t>(x.size());
  std::copy(both.begin(), middle, x.begin());
  std::copy(middle, both.end(), v.begin());
}
/// mass(body, slot) [kg]
template <class Bodies, class F>
void read_masses_of(Bodies const& bodies, SlotsById const& slots, std::span<std::int64_t const> ids,
                    std::span<double> m, F const& mass) {
  PIOLA_EXPECTS(m.size() == ids.size());
  slots.visit(ids, [&](std::size_t k, std::size_t body, Index slot) { m[k] = mass(*bodies[body], slot); });
}
template <class Bodies>
void add_velocities_of(Bodies const& bodies, int dimension, SlotsById const& slots, std::span<std::int64_t const> ids,
                       std::span<std::array<double, 3> const> change) {
  PIOLA_EXPECTS(change.size() == ids.size());
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  slots.visit(ids, [&](std::size_t k, std::size_t body, Index slot) {
    for (int c = 0; c < dimension; ++c)
      value_at(bodies[body]->state().v, slot, c) += change[k][static_cast<std::size_t>(c)];
  });
}

}  // namespace piola
