// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Wendland's function C2, scaled to support 2h (Wendland 1995; Dehnen and Aly 2012, table 1): no pairing of particles.
/// W(r, h) = sigma(D) / h^D w(r / h); with s = q / 2, for s < 1,
///   w = (1 - s)^4 (1 + 4 s) in two and three dimensions, (1 - s)^3 (1 + 3 s) in one.
struct WendlandC2 {
  static constexpr std::string_view name = "wendland_c2";
  static constexpr std::string_view about = "Wendland function C2, support 2h";
  static constexpr double support = 2;  ///< in units of h

  PIOLA_FN static double sigma(int dimension) {
    constexpr double pi = 3.14159265358979323846;
    return dimension == 1 ? 5.0 / 8 : dimension == 2 ? 7.0 / (4 * pi) : 21.0 / (16 * pi);
  }
  /// w(q), q = r / h
  template <class T>
  PIOLA_FN static T w(int dimension, T const& q) {
    T const s = 0.5 * q, a = maximum(1.0 - s, T(0.0)), cube = a * a * a;
    return dimension == 1 ? cube * (1.0 + 3.0 * s) : cube * a * (1.0 + 4.0 * s);
  }
  /// dw/dq
  template <class T>
  PIOLA_FN static T dw(int dimension, T const& q) {
    T const s = 0.5 * q, a = maximum(1.0 - s, T(0.0)), square = a * a;
    return dimension == 1 ? -6.0 * s * square : -10.0 * s * square * a;
  }
};

}  // namespace piola::inline PIOLA_BACKEND
