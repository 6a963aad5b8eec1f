// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/mechanics/actions.hpp"
#include "piola/mechanics/prescribed.hpp"
#include "piola/parallel/ranks.hpp"
#include <algorithm>
#include <limits>
#include <type_traits>

/// What a formulation says of bodies that do not touch each other, of all of them together.
namespace piola {

/// The sum of of(body) over the bodies that these point to.
template <class Bodies, class F>
auto sum_of(Bodies const& bodies, F const& of) {
  std::decay_t<decltype(of(*bodies.front()))> sum{};
  for (auto const& body : bodies) sum += of(*body);
  return sum;
}

/// What acts on such bodies. Of what supports and loads give in a step each rank knows its part: ranks add up when
/// somebody asks, or before anything else would be added to it.
class ActionsOnBodies : public Actions {
 public:
  using Actions::Actions;

  template <class Bodies>
  void begin_step(Bodies const& bodies, double dt) {
    if (due_) forget(bodies);
    begin(dt);
  }
  template <class Bodies>
  void end_step(Bodies const& bodies) {
    due_ = true;
    if (!ranks::several()) settle(bodies);
  }
  /// With what all ranks have given. Collective.
  template <class Bodies>
  ActionsOnBodies over_ranks(Bodies const& bodies) const {
    ActionsOnBodies all(*this);
    all.due_ = false;
    for (auto const& body : bodies)
      if (due_) body->boundary().hand_over(all);
    return all;
  }
  /// Collective.
  template <class Bodies>
  void settle(Bodies const& bodies) {
    if (!due_) return;
    *this = over_ranks(bodies);
    forget(bodies);
  }

 private:
  template <class Bodies>
  void forget(Bodies const& bodies) {
    for (auto const& body : bodies) body->boundary().forget_impulses();
    due_ = false;
  }

  bool due_ = false;
};

/// dt [s], or less, so that a step from `time` ends where a support or a load of a body does.
template <class Bodies>
double up_to_release_of(Bodies const& bodies, double time, double dt) {
  double rest = std::numeric_limits<double>::infinity();
  for (auto const& body : bodies) rest = std::min(rest, body->next_release(time) - time);
  return up_to_release(dt, rest);
}

}  // namespace piola
