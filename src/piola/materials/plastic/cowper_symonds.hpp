// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/base/parameter.hpp"
#include <array>
#include <cmath>
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Growth of the yield stress with the plastic strain rate: the factor 1 + (rate/C)^(1/p) (G. R. Cowper, P. S. Symonds,
/// Brown University, Division of Applied Mathematics, report 28, 1957).
struct CowperSymonds {
  static constexpr std::array<std::string_view, 2> words{"none", "cowper_symonds"};  ///< of `rate_dependence`
  static constexpr Condition when{"rate_dependence", "cowper_symonds"};
  static constexpr std::array parameters{
      Parameter{"cowper_symonds_c", "1/s", "C, plastic strain rate that doubles the yield stress", positive, no_default,
                "", when},
      Parameter{"cowper_symonds_p", "1", "p of (rate/C)^(1/p)", Interval{1, unbounded, false, true}, no_default, "",
                when}};

  /// v: values in the order of `parameters`; C = 0: no effect of rate.
  PIOLA_FN explicit CowperSymonds(double const* v) : C(v[0]), p(v[1]) {}

  PIOLA_FN bool counts() const { return C > 0; }
  /// Factor of the yield stress at a plastic strain rate [1/s].
  PIOLA_FN double factor(double rate) const { return counts() && rate > 0 ? 1 + std::pow(rate / C, 1 / p) : 1; }

  double C;  ///< [1/s]
  double p;
};

}  // namespace piola::inline PIOLA_BACKEND
