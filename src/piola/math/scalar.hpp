// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"

namespace piola::inline PIOLA_MACHINE {

/// a^(-1/3) for a > 0, to a few units in the last place. Between 1/4 and 4, where det F of a solid lives, only
/// arithmetic: Pade start (6 % off at the ends), then Newton steps y <- y (4 - a y^3) / 3, each squaring the error.
/// Outside, lane by lane, the library's cube root; so the result does not depend on the other lanes.
template <class T>
PIOLA_FN T power_minus_third(T const& a) {
  T y = (a + 2.0) / (2.0 * a + 1.0);
  for (int k = 0; k < 4; ++k) y = y * (4.0 - a * (y * y * y)) * (1.0 / 3.0);
  auto const outside = (a < 0.25) || (a > 4.0);
  if (any(outside)) y = select(outside, power_minus_third_exact(a), y);
  return y;
}

}  // namespace piola::inline PIOLA_MACHINE
