// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/particles/particle_set.hpp"
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

}  // namespace piola
