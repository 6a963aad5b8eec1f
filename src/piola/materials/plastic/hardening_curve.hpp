// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/materials/law_table.hpp"
#include "piola/math/root.hpp"
#include <cmath>

namespace piola::inline PIOLA_BACKEND {

/// Yield stress over plastic strain at rest: s0 + H ep + Q (1 - exp(-b ep)), or the straight lines between the rows of
/// a table, whose last value stays.
struct HardeningCurve {
  double yield = 0;    ///< s0 [Pa]
  double modulus = 0;  ///< H [Pa]
  double q = 0;        ///< Q [Pa]
  double b = 0;
  LawTable table{};  ///< no rows: the formula

  PIOLA_FN bool straight() const { return table.count == 0 && !(q > 0); }
  /// Yield stress and slope at a plastic strain [Pa].
  PIOLA_FN Sloped at(double strain) const {
    if (table.count > 0) return in_table(strain);
    double const grown = q > 0 ? -q * std::expm1(-b * strain) : 0;
    return {yield + modulus * strain + grown, modulus + b * (q - grown)};
  }

 private:
  PIOLA_FN Sloped in_table(double strain) const {
    int const last = table.count - 1;
    if (!(strain < table.x[last])) return {table.y[last], 0};
    int k = 0;
    while (k + 1 < last && strain >= table.x[k + 1]) ++k;
    double const slope = (table.y[k + 1] - table.y[k]) / (table.x[k + 1] - table.x[k]);
    return {table.y[k] + slope * (strain - table.x[k]), slope};
  }
};

}  // namespace piola::inline PIOLA_BACKEND
