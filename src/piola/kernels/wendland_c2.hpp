// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/machine.hpp"
#include <string_view>

namespace piola::inline PIOLA_MACHINE {

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
  PIOLA_FN static double w(int dimension, double q) {
    double const s = 0.5 * q, a = s < 1 ? 1 - s : 0, cube = a * a * a;
    return dimension == 1 ? cube * (1 + 3 * s) : cube * a * (1 + 4 * s);
  }
  /// dw/dq
  PIOLA_FN static double dw(int dimension, double q) {
    double const s = 0.5 * q, a = s < 1 ? 1 - s : 0, square = a * a;
    return dimension == 1 ? -6 * s * square : -10 * s * square * a;
  }
};

}  // namespace piola::inline PIOLA_MACHINE
