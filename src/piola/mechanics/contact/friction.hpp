// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include <cmath>

/// Coulomb friction of a touched point by a spring that is dragged along. Theory: docs/theory/contact.md, section 4.
namespace piola::contact {

/// The spring of one point on one surface.
struct Spring {
  Vec<3> stretch;  ///< xi, along the surface [m]
  Vec<3> force;    ///< on the point [N]
};

/// xi <- (1 - n (x) n) (last + jump), cut so that k |xi| <= mu f_n. last: the stretch before, turned along with the
/// body [m]; jump: how far the point moved over the surface since then [m]; n: unit normal; k [N/m]; bound: mu f_n [N].
inline Spring dragged(Vec<3> const& last, Vec<3> const& jump, Vec<3> const& n, double k, double bound) {
  Vec<3> const all = last + jump;
  Vec<3> xi = all - dot(n, all) * n;
  double const pull = k * std::sqrt(dot(xi, xi));
  if (pull > bound) xi = (bound / pull) * xi;
  return {xi, (-k) * xi};
}

/// What the force of a step that goes from `before` to `after` takes from the bodies over the jump [J].
inline double friction_work(Vec<3> const& before, Vec<3> const& after, Vec<3> const& jump) {
  return -0.5 * dot(before + after, jump);
}

}  // namespace piola::contact
