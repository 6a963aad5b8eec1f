// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/communicator.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/mechanics/prescribed.hpp"
#include "piola/mechanics/resultants.hpp"
#include <algorithm>
#include <limits>
#include <type_traits>

/// Sums and step limits over all bodies of a formulation.
namespace piola {

/// The sum of of(body) over the bodies; `bodies` holds pointers.
template <class Bodies, class F>
auto sum_over_bodies(Bodies const& bodies, F const& of) {
  std::decay_t<decltype(of(*bodies.front()))> sum{};
  for (auto const& body : bodies) sum += of(*body);
  return sum;
}

/// Impulses of supports and loads on several bodies. They are accumulated per rank, and reduced over ranks only when
/// read or before the next step adds to them.
class ActionsOnBodies : public Resultants {
 public:
  using Resultants::Resultants;

  template <class Bodies>
  void begin_step(Bodies const& bodies, double dt) {
    if (due_) forget(bodies);
    begin(dt);
  }
  template <class Bodies>
  void end_step(Bodies const& bodies) {
    due_ = true;
    if (!comm::is_parallel()) settle(bodies);
  }
  /// Returns a copy with the impulses of all ranks. Collective.
  template <class Bodies>
  ActionsOnBodies over_ranks(Bodies const& bodies) const {
    ActionsOnBodies all(*this);
    all.due_ = false;
    for (auto const& body : bodies)
      if (due_) body->boundary().add_resultants_to(all);
    return all;
  }
  /// Reduces the pending impulses over ranks. Collective.
  template <class Bodies>
  void settle(Bodies const& bodies) {
    if (!due_) return;
    *this = over_ranks(bodies);
    forget(bodies);
  }

 private:
  template <class Bodies>
  void forget(Bodies const& bodies) {
    for (auto const& body : bodies) body->boundary().reset_impulses();
    due_ = false;
  }

  bool due_ = false;
};

/// Returns dt [s], or a shorter step, so that a step from `time` ends where a support or a load of a body ends.
template <class Bodies>
double clip_step_to_end_time_of(Bodies const& bodies, double time, double dt) {
  double rest = std::numeric_limits<double>::infinity();
  for (auto const& body : bodies) rest = std::min(rest, body->next_end_time(time) - time);
  return clip_step_to_end_time(dt, rest);
}

}  // namespace piola
