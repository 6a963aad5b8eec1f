// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

/// Coulomb friction of a touched point by a spring that is dragged along. Theory: docs/theory/contact.md, section 4.
namespace piola::contact {

/// How much friction two surfaces have.
struct FrictionLaw {
  double kinetic = 0;                                            ///< mu_k, where they slide fast
  double still = 0;                                              ///< mu_s of surfaces at rest; 0: as mu_k
  double decay_speed = 0;                                        ///< v_d, between the two [m/s]
  double shear_limit = std::numeric_limits<double>::infinity();  ///< tau_max: no shear stress is larger [Pa]
  bool any() const { return kinetic > 0 || still > 0; }
};

/// mu(v) = mu_k + (mu_s - mu_k) exp(-v / v_d), v the speed of sliding [m/s].
inline double friction_coefficient(FrictionLaw const& law, double speed) {
  if (!(law.still > 0) || !(law.decay_speed > 0)) return law.kinetic;
  return law.kinetic + (law.still - law.kinetic) * std::exp(-speed / law.decay_speed);
}

/// The largest force along a surface [N]: min(mu f_n, tau_max A). Normal force [N], area [m2].
inline double friction_bound(FrictionLaw const& law, double normal_force, double area, double speed) {
  return std::min(friction_coefficient(law, speed) * normal_force, law.shear_limit * area);
}

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
