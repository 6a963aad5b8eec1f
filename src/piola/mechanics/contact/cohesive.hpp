// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

/// Traction of a joint by its jump: a linear spring with linear softening after a critical opening. Theory:
/// docs/theory/ties.md.
namespace piola::contact {

struct CohesiveLaw {
  double stiffness = 0;                                       ///< K [Pa/m]
  double strength = std::numeric_limits<double>::infinity();  ///< t_max [Pa]
  double last = std::numeric_limits<double>::infinity();      ///< delta_max: complete failure [m]
  double shear2 = 1;                                          ///< beta^2

  double first() const { return strength / stiffness; }  ///< delta_0: softening begins [m]
};

/// The area under the curve is G_c = t_max delta_max / 2.
inline CohesiveLaw cohesive_law(double stiffness, double strength, double toughness, double shear_weight) {
  if (!(strength > 0)) return {stiffness};
  return {stiffness, strength, 2 * toughness / strength, shear_weight * shear_weight};
}

/// t(delta) of a joint that opens for the first time [Pa].
inline double envelope(CohesiveLaw const& law, double opening) {
  if (opening <= law.first()) return law.stiffness * opening;
  return opening < law.last ? law.strength * (law.last - opening) / (law.last - law.first()) : 0;
}

/// Traction over opening after the largest opening d [Pa/m]: unloading goes straight to the origin.
inline double secant(CohesiveLaw const& law, double d) {
  return d <= law.first() ? law.stiffness : envelope(law, d) / d;
}

/// Energy dissipated at the largest opening d [J/m2].
inline double lost_energy(CohesiveLaw const& law, double d) {
  if (d <= law.first()) return 0;
  double const e = std::min(d, law.last), t = envelope(law, e);
  return 0.5 * law.strength * law.first() + 0.5 * (law.strength + t) * (e - law.first()) - 0.5 * t * e;
}

/// Components of a jump. n: outward normal of the body whose point has moved by `jump` from its tied position.
struct Separation {
  double open = 0;  ///< positive: open [m]
  Vec<3> slide;     ///< along the surface [m]
};
inline Separation separation(Vec<3> const& jump, Vec<3> const& n) {
  double const open = -dot(n, jump);
  return {open, jump + open * n};
}

/// delta, delta^2 = <open>^2 + beta^2 slide^2 [m].
inline double effective_opening(CohesiveLaw const& law, Separation const& s) {
  double const apart = std::max(s.open, 0.0);
  return std::sqrt(apart * apart + law.shear2 * dot(s.slide, s.slide));
}

/// Energy per area of a joint and its derivatives.
struct Bond {
  double energy = 0;          ///< [J/m2]
  Vec<3> by_jump, by_normal;  ///< [Pa], [J/m2]
};

/// A joint that never fails.
inline Bond elastic_bond(double stiffness, Vec<3> const& jump) {
  return {0.5 * stiffness * dot(jump, jump), stiffness * jump, {}};
}

/// After the largest opening d. Under compression a joint keeps its initial stiffness.
inline Bond cohesive_bond(CohesiveLaw const& law, Vec<3> const& jump, Vec<3> const& n, double d) {
  Separation const s = separation(jump, n);
  double const k = secant(law, d), across = s.open > 0 ? k : law.stiffness, along = k * law.shear2;
  return {0.5 * across * s.open * s.open + 0.5 * along * dot(s.slide, s.slide), along * s.slide - (across * s.open) * n,
          (s.open * (along - across)) * jump};
}

}  // namespace piola::contact
