// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/plastic/adiabatic_heating.hpp"
#include "piola/math/root.hpp"
#include <cmath>
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Flow stress of Zerilli and Armstrong (J. Appl. Phys. 61, 1987, pp. 1816-1825) for both lattices:
///   sy = C0 + (C1 + C2 sqrt(ep)) exp(-C3 T + C4 T ln rate) + C5 ep^n,
/// T in K, the rate in 1/s. Body-centred cubic metals: C2 = 0; face-centred cubic ones: C1 = C5 = 0. C0 holds the
/// athermal parts, that of the grain size too. Rates below 1e-8 /s count as that.
/// The increment solves mises - 3 mu dep = sy(ep + dep, dep/dt, T), with the temperature of the start of the step.
class ZerilliArmstrong {
 public:
  static constexpr std::string_view name = "zerilli_armstrong";
  static constexpr std::string_view about =
      "elastic solid in rate form, flow stress by thermally activated dislocations (Zerilli-Armstrong)";
  static constexpr bool yields = true, thermal = true, homologous = false, brittle = false, pressed = false;
  static constexpr std::array parameters{
      Parameter{"athermal_stress", "Pa", "C0, the part that neither rate nor temperature changes", not_negative, 0},
      Parameter{"thermal_stress", "Pa", "C1, of body-centred cubic metals", not_negative, 0},
      Parameter{"thermal_hardening", "Pa", "C2, times the root of the plastic strain, of face-centred cubic metals",
                not_negative, 0},
      Parameter{"thermal_softening", "1/K", "C3 in exp(-C3 T + C4 T ln rate)", not_negative},
      Parameter{"thermal_rate", "1/K", "C4 in exp(-C3 T + C4 T ln rate)", not_negative},
      Parameter{"hardening_coefficient", "Pa", "C5 of C5 ep^n", not_negative, 0},
      Parameter{"hardening_exponent", "1", "n of C5 ep^n", not_negative, 1}};

  PIOLA_FN ZerilliArmstrong(double const* v, Heat const&)
      : c0_(v[0]), c1_(v[1]), c2_(v[2]), c3_(v[3]), c4_(v[4]), c5_(v[5]), n_(v[6]) {}
  /// Yield stress of a state at a plastic strain rate [1/s] [Pa].
  PIOLA_FN double yield_stress(FlowState const& s, double rate) const {
    return athermal(s.plastic_strain) + barrier(s.plastic_strain) * activation(rate, s.temperature);
  }
  /// Plastic strain of a step of `dt` [s] whose trial stress has the von Mises stress `mises` [Pa].
  PIOLA_FN double increment(double mises, double three_mu, FlowState const& s, double dt, double = 0) const {
    double const start = yield_stress(s, 0);
    if (!(mises > start)) return 0;
    // The yield stress grows with strain and rate, so the increment without both is an upper bound.
    double const per_time = dt > 0 ? 1 / dt : 0;
    auto const miss = [&](double x) {
      double const strain = s.plastic_strain + x, rate = x * per_time, active = activation(rate, s.temperature);
      double const hard = c5_ > 0 ? n_ * c5_ * std::pow(strain, n_ - 1) : 0;
      double const forest = c2_ > 0 ? 0.5 * c2_ / std::sqrt(strain) * active : 0;
      double const fast = rate > slowest ? barrier(strain) * active * c4_ * s.temperature / x : 0;
      return Sloped{mises - three_mu * x - athermal(strain) - barrier(strain) * active,
                    -(three_mu + hard + forest + fast)};
    };
    return falling_root(miss, 0, (mises - start) / three_mu, 1e-15 * mises);
  }

 private:
  static constexpr double slowest = 1e-8;  ///< [1/s]

  PIOLA_FN double athermal(double strain) const { return c0_ + (c5_ > 0 ? c5_ * std::pow(strain, n_) : 0); }
  PIOLA_FN double barrier(double strain) const { return c1_ + c2_ * std::sqrt(strain); }
  PIOLA_FN double activation(double rate, double temperature) const {
    return std::exp(temperature * (c4_ * std::log(rate > slowest ? rate : slowest) - c3_));
  }

  double c0_, c1_, c2_, c3_, c4_, c5_, n_;
};

}  // namespace piola::inline PIOLA_BACKEND
