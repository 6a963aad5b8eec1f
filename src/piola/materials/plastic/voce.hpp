// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/plastic/isotropic_hardening.hpp"

namespace piola::inline PIOLA_BACKEND {

/// Hardening that saturates: sy0 + Q (1 - exp(-b ep)) + H ep (E. Voce, J. Inst. Metals 74, 1948, pp. 537-562; with the
/// linear part: J. Lemaitre, J.-L. Chaboche, Mechanics of Solid Materials, 1990, section 5.4).
class Voce : public IsotropicHardening {
 public:
  using Runs = IsotropicHardening;  ///< solids carry this part alone
  static constexpr std::string_view name = "voce";
  static constexpr std::string_view about =
      "elastic solid in rate form whose yield stress saturates with plastic strain (Voce)";
  static constexpr std::array parameters{
      Parameter{"yield_stress", "Pa", "s0, von Mises stress at first yield", positive},
      Parameter{"voce_q", "Pa", "Q of Q (1 - exp(-b ep)), by which the yield stress grows", not_negative},
      Parameter{"voce_b", "1", "b of Q (1 - exp(-b ep)): 63 % of Q are reached at ep = 1/b", positive},
      Parameter{"hardening_modulus", "Pa", "H of H ep, hardening that goes on", not_negative, 0},
      CowperSymonds::parameters[0],
      CowperSymonds::parameters[1]};

  PIOLA_FN Voce(double const* v, Heat const&)
      : IsotropicHardening(HardeningCurve{.yield = v[0], .modulus = v[3], .q = v[1], .b = v[2]}, v + 4) {}
};

}  // namespace piola::inline PIOLA_BACKEND
