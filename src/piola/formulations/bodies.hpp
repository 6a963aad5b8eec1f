// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/prescribed.hpp"
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

/// dt [s], or less, so that a step from `time` ends where a support or a load of a body does.
template <class Bodies>
double up_to_release_of(Bodies const& bodies, double time, double dt) {
  double rest = std::numeric_limits<double>::infinity();
  for (auto const& body : bodies) rest = std::min(rest, body->next_release(time) - time);
  return up_to_release(dt, rest);
}

}  // namespace piola
