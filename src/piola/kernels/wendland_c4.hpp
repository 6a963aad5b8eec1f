// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Wendland's function C4, scaled to support 2h (Wendland 1995; Dehnen and Aly 2012, table 1): no pairing of particles.
/// W(r, h) = sigma(D) / h^D w(r / h); with s = q / 2, for s < 1,
///   w = (1 - s)^6 (1 + 6 s + 35/3 s^2) in two and three dimensions, (1 - s)^5 (1 + 5 s + 8 s^2) in one.
struct WendlandC4 {
  static constexpr std::string_view name = "wendland_c4";
  static constexpr std::string_view about = "Wendland function C4, support 2h";
  static constexpr double support = 2;  ///< in units of h

  PIOLA_FN static double sigma(int dimension) {
    constexpr double pi = 3.14159265358979323846;
    return dimension == 1 ? 3.0 / 4 : dimension == 2 ? 9.0 / (4 * pi) : 495.0 / (256 * pi);
  }
  /// w(q), q = r / h
  PIOLA_FN static double w(int dimension, double q) {
    double const s = 0.5 * q, a = s < 1 ? 1 - s : 0, fifth = a * a * a * a * a;
    return dimension == 1 ? fifth * (1 + s * (5 + 8 * s)) : fifth * a * (1 + s * (6 + 35.0 / 3 * s));
  }
  /// dw/dq
  PIOLA_FN static double dw(int dimension, double q) {
    double const s = 0.5 * q, a = s < 1 ? 1 - s : 0, fourth = a * a * a * a;
    return dimension == 1 ? -7 * s * (1 + 4 * s) * fourth : -28.0 / 3 * s * (1 + 5 * s) * fourth * a;
  }
};

}  // namespace piola::inline PIOLA_BACKEND
