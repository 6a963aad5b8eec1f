// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

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
  template <class T>
  PIOLA_FN static T w(T const& q) {
    T const a = maximum(2.0 - q, T(0.0)), b = maximum(1.0 - q, T(0.0));
    return 0.25 * a * a * a - b * b * b;
  }
  /// dw/dq
  template <class T>
  PIOLA_FN static T dw(T const& q) {
    T const a = maximum(2.0 - q, T(0.0)), b = maximum(1.0 - q, T(0.0));
    return -0.75 * a * a + 3.0 * b * b;
  }
};

}  // namespace piola::inline PIOLA_BACKEND
