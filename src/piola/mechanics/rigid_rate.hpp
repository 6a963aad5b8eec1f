// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/solve.hpp"

namespace piola::inline PIOLA_BACKEND {

/// A rigid-body rate  spin cross (x - centre) + push.
struct RigidRate {
  double spin[3]{}, push[3]{}, centre[3]{};
};

/// Sums over a body of a rate f with weights V, arms x from any common origin; unused components zero.
struct RateSums {
  double volume = 0;
  double x[3]{};       ///< sum V x
  double xx[6]{};      ///< sum V x (x) x: XX YY ZZ XY YZ XZ
  double f[3]{};       ///< sum V f
  double moment[3]{};  ///< sum V x cross f
};

/// The rigid rate g for which f + g has no resultant and no moment: sum V (f + g) = 0, sum V x cross (f + g) = 0
/// (Lee et al. eqs. 47-49). Measured from the centroid, resultant and moment decouple:
///   push = -sum V f / sum V,   spin = -I^-1 sum V r cross f,   I = sum V (r.r 1 - r (x) r).
/// Directions in which the body has no inertia (1D, or 2D out of its plane) get no spin.
PIOLA_INLINE_FN RigidRate balancing_rate(RateSums const& s, int dimension) {
  RigidRate g;
  for (int c = 0; c < 3; ++c) {
    g.push[c] = -s.f[c] / s.volume;
    g.centre[c] = s.x[c] / s.volume;
  }
  double const* const o = g.centre;
  double const torque[3] = {s.moment[0] - (o[1] * s.f[2] - o[2] * s.f[1]),
                            s.moment[1] - (o[2] * s.f[0] - o[0] * s.f[2]),
                            s.moment[2] - (o[0] * s.f[1] - o[1] * s.f[0])};
  double const xx = s.xx[0] - s.volume * o[0] * o[0], yy = s.xx[1] - s.volume * o[1] * o[1],
               zz = s.xx[2] - s.volume * o[2] * o[2], xy = s.xx[3] - s.volume * o[0] * o[1],
               yz = s.xx[4] - s.volume * o[1] * o[2], xz = s.xx[5] - s.volume * o[0] * o[2];
  if (dimension == 2) g.spin[2] = -torque[2] / (xx + yy);
  if (dimension == 3) {
    double inertia[9] = {yy + zz, -xy, -xz, -xy, xx + zz, -yz, -xz, -yz, xx + yy};
    double b[3] = {-torque[0], -torque[1], -torque[2]};
    if (solve_in_place<3>(inertia, b) > 1e-12)
      for (int c = 0; c < 3; ++c) g.spin[c] = b[c];
  }
  return g;
}

/// Power of a rigid rate on velocities with the sums `v` (f is the velocity): sum V v.(spin cross (x - centre) + push).
PIOLA_FN double power_of(RigidRate const& g, RateSums const& v) {
  double const* const o = g.centre;
  double const about_centre[3] = {v.moment[0] - (o[1] * v.f[2] - o[2] * v.f[1]),
                                  v.moment[1] - (o[2] * v.f[0] - o[0] * v.f[2]),
                                  v.moment[2] - (o[0] * v.f[1] - o[1] * v.f[0])};
  double power = 0;
  for (int c = 0; c < 3; ++c) power += g.spin[c] * about_centre[c] + g.push[c] * v.f[c];
  return power;
}

}  // namespace piola::inline PIOLA_BACKEND
