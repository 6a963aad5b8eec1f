// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/machine.hpp"
#include <string_view>

namespace piola::inline PIOLA_MACHINE {

/// Cubic B-spline of support 2h (Monaghan and Lattanzio 1985). W(r, h) = sigma(D) / h^D w(r / h).
struct CubicSpline {
  static constexpr std::string_view name = "cubic_spline";
  static constexpr std::string_view about = "cubic B-spline, support 2h";
  static constexpr double support = 2;  ///< in units of h

  PIOLA_FN static double sigma(int dimension) {
    constexpr double pi = 3.14159265358979323846;
    return dimension == 1 ? 2.0 / 3.0 : dimension == 2 ? 10.0 / (7.0 * pi) : 1.0 / pi;
  }
  /// w(q), q = r / h
  PIOLA_FN static double w(double q) {
    double const a = q < 2 ? 2 - q : 0, b = q < 1 ? 1 - q : 0;
    return 0.25 * a * a * a - b * b * b;
  }
  /// dw/dq
  PIOLA_FN static double dw(double q) {
    double const a = q < 2 ? 2 - q : 0, b = q < 1 ? 1 - q : 0;
    return -0.75 * a * a + 3 * b * b;
  }
};

}  // namespace piola::inline PIOLA_MACHINE
