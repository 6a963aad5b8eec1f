// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Quartic B-spline M5 of support 2.5h (Schoenberg 1946; Price 2012, eq. 7). W(r, h) = sigma(D) / h^D w(r / h),
///   w = (5/2 - q)^4 - 5 (3/2 - q)^4 + 10 (1/2 - q)^4, each power only where its base is positive.
struct TrialKernel {
  static constexpr std::string_view name = "trial_kernel";
  static constexpr std::string_view about = "a trial";
  static constexpr double support = 2.5;  ///< in units of h

  PIOLA_FN static double sigma(int dimension) {
    constexpr double pi = 3.14159265358979323846;
    return dimension == 1 ? 1.0 / 24 : dimension == 2 ? 96.0 / (1199 * pi) : 1.0 / (20 * pi);
  }
  /// w(q), q = r / h
  PIOLA_FN static double w(double q) {
    double const a = q < 2.5 ? 2.5 - q : 0, b = q < 1.5 ? 1.5 - q : 0, c = q < 0.5 ? 0.5 - q : 0;
    return a * a * a * a - 5 * b * b * b * b + 10 * c * c * c * c;
  }
  /// dw/dq
  PIOLA_FN static double dw(double q) {
    double const a = q < 2.5 ? 2.5 - q : 0, b = q < 1.5 ? 1.5 - q : 0, c = q < 0.5 ? 0.5 - q : 0;
    return -4 * (a * a * a - 5 * b * b * b + 10 * c * c * c);
  }
};

}  // namespace piola::inline PIOLA_BACKEND
