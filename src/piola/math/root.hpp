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

}  // namespace piola::inline PIOLA_BACKEND
