// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/scalar.hpp"
#include "piola/math/tensor.hpp"

/// Plane stress and uniaxial stress: the stretch of the missing directions at one point. Theory: docs/theory/nodal.md,
/// section 2.
namespace piola::nodal::inline PIOLA_BACKEND {

/// Finds the stretch l of the directions from D on with P_cc(F, l) = 0. In: F with any value; out: F with the solution.
/// Secant steps from the stretch of linear elasticity; each lane iterates and stops independently.
template <int D, class Law>
class StressFree {
 public:
  PIOLA_FN StressFree(Law const& law)
      : law_(law),
        lateral_(D == 2 ? law.lambda / (law.lambda + 2 * law.mu) : law.lambda / (2 * (law.lambda + law.mu))) {}

  PIOLA_FN void operator()(Mat<3, Lanes>& F) const {
    constexpr int most_steps = 40;
    Lanes l = start(F), before = 1.001 * l;
    put(F, before);
    Lanes force_before = lateral_force(F);
    auto moving = l > 0.0;
    for (int n = 0; n < most_steps && any(moving); ++n) {
      put(F, l);
      Lanes const force = lateral_force(F), slope = (force - force_before) / (l - before);
      // At least half and at most twice the present stretch.
      Lanes const next = minimum(maximum(Lanes(l - force / slope), 0.5 * l), 2.0 * l), step = next - l;
      force_before = select(moving, force, force_before);
      before = select(moving, l, before);
      l = select(moving, next, l);
      moving = moving && (maximum(step, 0.0 - step) > 1e-9 * l);
    }
    put(F, l);
  }

 private:
  /// 1 / (1 + nu' (j - 1)) for the in-plane volume ratio j: exact for small strain, and of the right size beyond.
  PIOLA_FN Lanes start(Mat<3, Lanes> const& F) const {
    Lanes const j = D == 2 ? Lanes(F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0)) : F(0, 0);
    return 1.0 / (1.0 + lateral_ * (j - 1.0));
  }
  PIOLA_FN static void put(Mat<3, Lanes>& F, Lanes const& l) {
    for (int c = D; c < 3; ++c) F(c, c) = l;
  }
  PIOLA_FN Lanes lateral_force(Mat<3, Lanes> const& F) const { return law_.first_piola(F)(2, 2); }

  Law const& law_;
  double lateral_;  ///< of linear elasticity: lateral strain over in-plane strain, with its sign
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
