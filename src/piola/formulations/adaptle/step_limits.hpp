// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/component_views.hpp"
#include "piola/math/tensor.hpp"

namespace piola::adaptle::inline PIOLA_BACKEND {

/// Largest relative change of a volume, or of the spacing between bodies, in a step: with 0.1 the time error of an
/// impact at several km/s shows in the fourth digit of its energy.
inline constexpr double largest_change = 0.05;

/// Quantities that limit the step of a group of particles.
struct StepLimit {
  Lanes stretch;       ///< of the smoothing length, F^-1, squared: see stretch_squared; 1: nothing is compressed
  Lanes length;        ///< h at rest [m]
  Lanes sheared_cfl;   ///< Courant number of the compressed length; at least that of `length`
  Lanes speed;         ///< of sound and viscosity [m/s]
  Lanes acceleration;  ///< squared [m2/s4]
  Lanes mass;          ///< [kg]
  Lanes stiffness;     ///< of contacts [N/m]
  Lanes rate;          ///< of volume, or closing rate of bodies [1/s]

  /// The stable step [s]: the smallest of CFL h / c, with the current speed of sound and the quadratic viscosity, h
  /// that at rest or, with sheared_cfl, the compressed length of material pairs; 0.25 sqrt(h / |a|); 0.5 sqrt(m / k) of
  /// contacts; and the step in which a volume, or the spacing between bodies, changes by `largest_change`. NaN is
  /// detected elsewhere.
  PIOLA_FN Lanes step(double cfl, double h) const {
    Lanes const never(1e300);
    Lanes const compressed = length / square_root(maximum(stretch, Lanes(1.0)));
    Lanes step = minimum(cfl * length, sheared_cfl * compressed) / speed;
    Lanes const a = square_root(acceleration);
    step = shorter(step, select(a > 0.0, 0.25 * square_root(h / a), never));
    step = shorter(step, select(stiffness > 0.0, 0.5 * square_root(mass / stiffness), never));
    return select(rate * step > largest_change, largest_change / rate, step);
  }
  PIOLA_FN static Lanes shorter(Lanes const& a, Lanes const& b) { return select(b < a, b, a); }

  /// The largest eigenvalue of A A^T, or an upper bound: q + 2 p with q = tr/3 and p^2 = B:B/6 of the deviator B.
  PIOLA_FN static Lanes stretch_squared(Mat<3, Lanes> const& A) {
    Lanes q(0.0), B(0.0);
    for (Lanes const& a : A.c) q += a * a;
    q = q / 3.0;
    for (int a = 0; a < 3; ++a)
      for (int b = a; b < 3; ++b) {
        Lanes sum = A(a, 0) * A(b, 0) + A(a, 1) * A(b, 1) + A(a, 2) * A(b, 2);
        if (a == b) sum = sum - q;
        B += (a == b ? 1.0 : 2.0) * sum * sum;
      }
    return q + 2.0 * square_root(B / 6.0);
  }
};

}  // namespace piola::adaptle::inline PIOLA_BACKEND
