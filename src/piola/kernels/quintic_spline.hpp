// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Quintic B-spline M6 of support 3h (Schoenberg 1946; Price 2012, eq. 8). W(r, h) = sigma(D) / h^D w(r / h),
///   w = (3 - q)^5 - 6 (2 - q)^5 + 15 (1 - q)^5, each power only where its base is positive.
struct QuinticSpline {
  static constexpr std::string_view name = "quintic_spline";
  static constexpr std::string_view about = "quintic B-spline, support 3h";
  static constexpr double support = 3;  ///< in units of h

  PIOLA_FN static double sigma(int dimension) {
    constexpr double pi = 3.14159265358979323846;
    return dimension == 1 ? 1.0 / 120 : dimension == 2 ? 7.0 / (478 * pi) : 1.0 / (120 * pi);
  }
  /// w(q), q = r / h
  PIOLA_FN static double w(double q) {
    double const a = q < 3 ? 3 - q : 0, b = q < 2 ? 2 - q : 0, c = q < 1 ? 1 - q : 0;
    return a * a * a * a * a - 6 * b * b * b * b * b + 15 * c * c * c * c * c;
  }
  /// dw/dq
  PIOLA_FN static double dw(double q) {
    double const a = q < 3 ? 3 - q : 0, b = q < 2 ? 2 - q : 0, c = q < 1 ? 1 - q : 0;
    return -5 * (a * a * a * a - 6 * b * b * b * b + 15 * c * c * c * c);
  }
};

}  // namespace piola::inline PIOLA_BACKEND
