// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/plastic/adiabatic_heating.hpp"
#include "piola/math/lanes.hpp"
#include <cmath>
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Flow stress of Johnson and Cook (Proc. 7th Int. Symp. Ballistics, The Hague 1983, pp. 541-547):
///   sy = (A + B ep^n) (1 + C ln max(rate/rate0, 1)) (1 - T*^m),  T* = (T - Tr)/(Tm - Tr) between 0 and 1.
/// The increment solves mises - 3 mu dep = sy(ep + dep, dep/dt, T), with the temperature of the start of the step.
class JohnsonCook {
 public:
  static constexpr std::string_view name = "johnson_cook";
  static constexpr std::string_view about = "elastic solid in rate form, flow stress by strain, rate and temperature";
  static constexpr bool yields = true, thermal = true, homologous = true, brittle = false, pressed = false;
  static constexpr std::array parameters{Parameter{"yield_stress", "Pa", "A, flow stress at first yield", positive},
                                         Parameter{"hardening_coefficient", "Pa", "B of B ep^n", not_negative},
                                         Parameter{"hardening_exponent", "1", "n of B ep^n", not_negative},
                                         Parameter{"rate_coefficient", "1", "C of the rate term", not_negative, 0},
                                         Parameter{"thermal_exponent", "1", "m of T*^m", positive, 1}};

  PIOLA_FN JohnsonCook(double const* v, Heat const& heat)
      : a_(v[0]), b_(v[1]), n_(v[2]), c_(v[3]), m_(v[4]), heat_(heat) {}
  /// Yield stress of a state at a plastic strain rate [1/s] [Pa].
  PIOLA_FN double yield_stress(FlowState const& s, double rate) const {
    return static_stress(s.plastic_strain) * (1 + c_ * heat_.log_rate(rate)) * softening(s.temperature);
  }
  /// Plastic strain of a step of `dt` [s] whose trial stress has the von Mises stress `mises` [Pa]: Newton's method,
  /// halving where it leaves the interval that is known to hold the root. dt = 0: no effect of rate. last_flow: a guess
  /// of the flow stress [Pa], from which the search starts; 0: none.
  PIOLA_FN double increment(double mises, double three_mu, FlowState const& s, double dt, double last_flow = 0) const {
    double const plastic_strain = s.plastic_strain, temperature = s.temperature;
    // Most particles: no power is needed to see that they stay elastic (T*^m is at most T* for m >= 1).
    if (m_ >= 1 && !(mises > a_ * (1 - heat_.homologous(temperature)))) return 0;
    double const soft = softening(temperature);
    if (!(mises > a_ * soft)) return 0;
    double const grown = static_stress(plastic_strain) - a_, start = (a_ + grown) * soft;
    if (!(mises > start)) return 0;
    // The yield stress grows with strain and rate, so the increment without both is an upper bound.
    double low = 0, high = (mises - start) / three_mu, x = high;
    if (last_flow > start && last_flow < mises) x = (mises - last_flow) / three_mu;
    double const per_time = dt > 0 ? 1 / dt : 0, per_strain = plastic_strain > 0 ? 1 / plastic_strain : 0;
    for (int k = 0; k < 100; ++k) {
      double const rate = x * per_time, fast = 1 + c_ * heat_.log_rate(rate), strain = plastic_strain + x;
      double const hard = hardening(grown, x * per_strain, strain);
      double const miss = mises - three_mu * x - (a_ + hard) * fast * soft;
      if (std::abs(miss) <= 1e-15 * mises) break;
      (miss > 0 ? low : high) = x;
      double slope = three_mu * strain * x + n_ * hard * x * fast * soft;  // times x and strain: one division
      if (rate > heat_.reference_rate) slope += (a_ + hard) * c_ * strain * soft;
      double next = x + miss * (x * strain) / slope;
      bool const inside = next > low && next < high;
      if (!inside) next = 0.5 * (low + high);
      // The error after a step of Newton's is the square of the one before, so a small step is the last one.
      bool const last = next == x || (inside && std::abs(next - x) <= 1e-6 * x);
      x = next;
      if (last) break;
    }
    return x;
  }

  /// No state at this temperature [K] yields at less [Pa] (T*^m is at most T* for m >= 1).
  template <class V>
  PIOLA_FN V least_yield_stress(V const& temperature) const {
    if (!(m_ >= 1)) return V(0.0);
    V const part = (temperature - heat_.reference) * (1 / (heat_.melting - heat_.reference));
    return (a_ * (1 - 1e-12)) * (1.0 - minimum(maximum(part, V(0.0)), V(1.0)));
  }

 private:
  /// B strain^n, strain = (1 + z) times the one where it is `grown`. Most increments are small relative to the present
  /// strain; then the series of (1 + z)^n is exact to round-off.
  PIOLA_FN double hardening(double grown, double z, double strain) const {
    if (!(z > 0 && z < 0.01)) return b_ * std::pow(strain, n_);
    double series = 1;
    for (int k = 7; k > 0; --k) series = 1 + series * z * (n_ - (k - 1)) * (1.0 / k);
    return grown * series;
  }
  PIOLA_FN double static_stress(double strain) const { return a_ + b_ * std::pow(strain > 0 ? strain : 0, n_); }
  PIOLA_FN double softening(double temperature) const {
    double const part = heat_.homologous(temperature);
    return part <= 0 ? 1 : part >= 1 ? 0 : 1 - std::pow(part, m_);
  }

  double a_, b_, n_, c_, m_;
  Heat heat_;
};

}  // namespace piola::inline PIOLA_BACKEND
