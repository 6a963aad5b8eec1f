// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

/// Coulomb friction of a contact point by an elastic-slip spring. Theory: docs/theory/contact.md, section 4.
namespace piola::contact {

/// Friction law of two surfaces.
struct FrictionLaw {
  double kinetic = 0;                                            ///< mu_k, kinetic coefficient at high speed
  double still = 0;                                              ///< mu_s, static coefficient; 0: equal to mu_k
  double decay_speed = 0;                                        ///< v_d, transition speed [m/s]
  double shear_limit = std::numeric_limits<double>::infinity();  ///< tau_max: limit of the shear stress [Pa]
  bool any() const { return kinetic > 0 || still > 0; }
};

/// mu(v) = mu_k + (mu_s - mu_k) exp(-v / v_d) with the sliding speed v [m/s].
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

/// Return mapping: xi <- (1 - n (x) n) (last + jump), scaled so that k |xi| <= bound. last: the previous stretch,
/// rotated with the body [m]; jump: displacement of the point over the surface since then [m]; n: unit normal; k [N/m];
/// bound: mu f_n [N].
inline Spring slip_return_map(Vec<3> const& last, Vec<3> const& jump, Vec<3> const& n, double k, double bound) {
  Vec<3> const all = last + jump;
  Vec<3> xi = all - dot(n, all) * n;
  double const pull = k * std::sqrt(dot(xi, xi));
  if (pull > bound) xi = (bound / pull) * xi;
  return {xi, (-k) * xi};
}

/// Work that friction takes from the bodies over the jump [J], as the force goes from `before` to `after`.
inline double friction_work(Vec<3> const& before, Vec<3> const& after, Vec<3> const& jump) {
  return -0.5 * dot(before + after, jump);
}

/// Friction at one point over one step.
struct FrictionState {
  Spring spring;
  double work = 0;    ///< taken from the bodies [J]
  double energy = 0;  ///< stored in the spring [J]
};

/// last: the previous spring, rotated with the surface; null: a new contact, which starts without stretch. jump [m] and
/// dt [s] since then; n: unit normal; k [N/m]; normal force [N] and area [m2] for the law.
inline FrictionState update_friction(Spring const* last, Vec<3> const& jump, Vec<3> const& n, double k,
                                     FrictionLaw const& law, double normal_force, double area, double dt) {
  Vec<3> const along = jump - dot(n, jump) * n;
  double const way = last != nullptr ? std::sqrt(dot(along, along)) : 0;
  double const bound = friction_bound(law, normal_force, area, dt > 0 ? way / dt : 0);
  Spring const spring =
      slip_return_map(last != nullptr ? last->stretch : Vec<3>{}, last != nullptr ? jump : Vec<3>{}, n, k, bound);
  return {spring, last != nullptr ? friction_work(last->force, spring.force, jump) : 0,
          0.5 * k * dot(spring.stretch, spring.stretch)};
}

}  // namespace piola::contact
