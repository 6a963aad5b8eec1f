// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include <cmath>

namespace piola::inline PIOLA_BACKEND {

/// A function at a place, and its derivative there.
struct Sloped {
  double value, slope;
};

/// Root of a decreasing function between `low`, where it is positive, and `high`, where it is not. Newton's method with
/// bisection where a step leaves the bracketing interval. `small`: a value that counts as zero.
template <class F>
PIOLA_FN double falling_root(F const& f, double low, double high, double small) {
  double x = high;
  for (int k = 0; k < 200; ++k) {
    Sloped const at = f(x);
    if (std::fabs(at.value) <= small) break;
    (at.value > 0 ? low : high) = x;
    double next = x - at.value / at.slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == x) break;
    x = next;
  }
  return x;
}

/// Root of such a function without its derivative, by the secant method of Illinois: an end of the bracket that stays
/// counts half. `f_low` > 0 and `f_high` <= 0 are the values at the ends. Jumps to negative values are allowed.
template <class F>
PIOLA_FN double falling_root(F const& f, double low, double f_low, double high, double f_high, double small) {
  double x = high;
  for (int k = 0; k < 200; ++k) {
    // Every fourth step bisects, so that the bracket shrinks whatever the function is.
    double const secant = low + (high - low) * (f_low / (f_low - f_high));
    double const next = k % 4 == 3 || !(secant > low && secant < high) ? 0.5 * (low + high) : secant;
    if (next == x || !(next > low && next < high)) break;
    x = next;
    double const value = f(x);
    if (std::fabs(value) <= small) break;
    if (value > 0) {
      low = x, f_low = value, f_high *= 0.5;
    } else {
      high = x, f_high = value, f_low *= 0.5;
    }
  }
  return x;
}

}  // namespace piola::inline PIOLA_BACKEND
