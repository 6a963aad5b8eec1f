// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"

namespace piola::inline PIOLA_BACKEND {

/// a^(-1/3) for a > 0, to a few units in the last place. Between 1/4 and 4, where det F of a solid lives, only
/// arithmetic: Pade start (6 % off at the ends), then Newton steps y <- y (4 - a y^3) / 3, each squaring the error.
/// Outside, lane by lane, the library's cube root; so the result does not depend on the other lanes.
template <class T>
PIOLA_INLINE_FN T power_minus_third(T const& a) {
  T y = (a + 2.0) / (2.0 * a + 1.0);
  for (int k = 0; k < 4; ++k) y = y * (4.0 - a * (y * y * y)) * (1.0 / 3.0);
  auto const outside = (a < 0.25) || (a > 4.0);
  if (any(outside)) y = select(outside, power_minus_third_exact(a), y);
  return y;
}

/// ln a for a > 0, to a few units in the last place. Between 1/4 and 4, where det F of a solid lives, only arithmetic:
/// halved or doubled (both exact) into [0.7, 1.42], then ln m = 2 (z + z^3/3 + ... + z^21/21) with z = (m - 1) / (m +
/// 1), |z| < 0.175; what is left out is below 1e-17 of the result. Outside, lane by lane, the library's logarithm; so
/// the result does not depend on the other lanes.
template <class T>
PIOLA_INLINE_FN T logarithm(T const& a) {
  T m = a, halvings = T(0.0);
  for (int k = 0; k < 2; ++k) {
    auto const high = m > 1.42;
    m = select(high, 0.5 * m, m);
    halvings = select(high, halvings + 1.0, halvings);
    auto const low = m < 0.7;
    m = select(low, 2.0 * m, m);
    halvings = select(low, halvings - 1.0, halvings);
  }
  T const z = (m - 1.0) / (m + 1.0), z2 = z * z;
  T series = T(1.0 / 21.0);
  for (int n = 19; n > 0; n -= 2) series = series * z2 + 1.0 / n;
  T y = 0.6931471805599453 * halvings + 2.0 * (z * series);
  auto const outside = (a < 0.25) || (a > 4.0);
  if (any(outside)) y = select(outside, logarithm_exact(a), y);
  return y;
}

}  // namespace piola::inline PIOLA_BACKEND
