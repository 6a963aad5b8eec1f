// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/plastic/isotropic_hardening.hpp"

namespace piola::inline PIOLA_BACKEND {

/// Hardening by a table: the yield stress at plastic strains, straight between them, the last one beyond (as Abaqus,
/// *PLASTIC, has it).
class TabulatedHardening : public IsotropicHardening {
 public:
  using Runs = IsotropicHardening;  ///< solids carry this part alone
  static constexpr std::string_view name = "tabulated_hardening";
  static constexpr std::string_view about =
      "elastic solid in rate form with a table of yield stress over plastic strain";
  static constexpr TableParameter table{"hardening_curve", "plastic strain", "1", "yield stress", "Pa"};
  static constexpr std::array parameters{CowperSymonds::parameters[0], CowperSymonds::parameters[1]};

  PIOLA_FN TabulatedHardening(double const* v, Heat const&, LawTable const& rows)
      : IsotropicHardening(HardeningCurve{.table = rows}, v) {}
};

}  // namespace piola::inline PIOLA_BACKEND
