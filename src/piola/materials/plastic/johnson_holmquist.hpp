// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/eos/polynomial.hpp"
#include "piola/materials/plastic/adiabatic_heating.hpp"
#include "piola/math/root.hpp"
#include <cmath>
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Strength of glass and ceramics by pressure and damage: the second model of Johnson and Holmquist (AIP Conf. Proc.
/// 309, 1994, pp. 981-984). With P* = P/P_HEL, T* = T/P_HEL and stresses over sigma_HEL = 3/2 (HEL - P_HEL):
///   intact     si = A (P* + T*)^N (1 + C ln max(rate/rate0, 1))
///   fractured  sf = B P*^M (1 + C ln max(rate/rate0, 1)), at most a given value
///   sy = si - D (si - sf),  D grows by (plastic strain of the step) / (D1 (P* + T*)^D2)
/// The rate is the plastic one. Tension is limited to T (1 - D). Shear energy that damage takes becomes pressure:
///   dP' = -K m + sqrt((K m + dP)^2 + 2 beta K dU),  U = sy^2 / (6 mu),  m = rho/rho0 - 1 > 0.
class JohnsonHolmquist {
 public:
  static constexpr std::string_view name = "johnson_holmquist";
  static constexpr std::string_view about =
      "brittle solid in rate form (glass, ceramics), strength by pressure and damage (Johnson-Holmquist 2)";
  using Eos = PolynomialEos;  ///< the model includes it
  static constexpr bool yields = true, thermal = false, homologous = false, brittle = true, pressed = true;
  static constexpr std::array parameters{
      Parameter{"hugoniot_elastic_limit", "Pa", "HEL, axial stress at yield in uniaxial compression", positive},
      Parameter{"pressure_at_limit", "Pa", "P_HEL, pressure at the Hugoniot elastic limit", positive},
      Parameter{"tensile_strength", "Pa", "T, largest hydrostatic tension of intact material", positive},
      Parameter{"intact_strength", "1", "A of the intact strength", positive},
      Parameter{"intact_exponent", "1", "N of the intact strength", not_negative},
      Parameter{"fractured_strength", "1", "B of the fractured strength", not_negative, 0},
      Parameter{"fractured_exponent", "1", "M of the fractured strength", not_negative, 1},
      Parameter{"largest_fractured_strength", "1", "largest fractured strength, over 3/2 (HEL - P_HEL)", positive,
                unbounded, "no limit"},
      Parameter{"rate_coefficient", "1", "C of the rate term", not_negative, 0},
      Parameter{"fracture_coefficient", "1", "D1 of the plastic strain to fracture", positive},
      Parameter{"fracture_exponent", "1", "D2 of the plastic strain to fracture", not_negative},
      Parameter{"bulking", "1", "beta, part of the lost shear energy that becomes pressure", Interval{0, 1}, 1},
      Parameter{"rate_of_reference", "1/s", "rate0, plastic strain rate above which rate counts", positive, 1}};

  PIOLA_FN JohnsonHolmquist(double const* v, Heat const&)
      : scale_(1.5 * (v[0] - v[1])),
        per_pressure_(1 / v[1]),
        tension_(v[2]),
        A_(v[3]),
        N_(v[4]),
        B_(v[5]),
        M_(v[6]),
        most_(v[7]),
        C_(v[8]),
        D1_(v[9]),
        D2_(v[10]),
        beta_(v[11]),
        rate0_(v[12]) {}

  /// Strength without damage [Pa].
  PIOLA_FN double intact(double pressure, double rate) const {
    double const P = (pressure + tension_) * per_pressure_;
    return P > 0 ? scale_ * A_ * std::pow(P, N_) * fast(rate) : 0;
  }
  /// Strength of the fractured material [Pa].
  PIOLA_FN double fractured(double pressure, double rate) const {
    double const P = pressure * per_pressure_;
    if (!(P > 0)) return 0;
    double const sf = B_ * std::pow(P, M_) * fast(rate);
    return scale_ * (sf < most_ ? sf : most_);
  }
  /// Yield stress of a state at a plastic strain rate [1/s] [Pa].
  PIOLA_FN double yield_stress(FlowState const& s, double rate) const {
    double const whole = intact(s.pressure, rate), broken = fractured(s.pressure, rate);
    return whole - s.damage * (whole - broken);
  }
  /// Plastic strain of a step of `dt` [s] whose trial stress has the von Mises stress `mises` [Pa].
  PIOLA_FN double increment(double mises, double three_mu, FlowState const& s, double dt, double = 0) const {
    double const slow = yield_stress(s, 0);
    if (!(mises > slow)) return 0;
    double const high = (mises - slow) / three_mu, per_time = dt > 0 ? 1 / dt : 0;
    if (!(C_ * high * per_time > C_ * rate0_)) return high;
    auto const miss = [&](double x) {
      double const rate = x * per_time;
      // The limit on the fractured strength makes the true slope no steeper than this one.
      return Sloped{mises - three_mu * x - yield_stress(s, rate), -(three_mu + (rate > rate0_ ? C_ * slow / x : 0))};
    };
    return falling_root(miss, 0, high, 1e-15 * mises);
  }

  /// Plastic strain at which intact material is broken; 0 where tension reaches T.
  PIOLA_FN double fracture_strain(double pressure) const {
    double const P = (pressure + tension_) * per_pressure_;
    return P > 0 ? D1_ * std::pow(P, D2_) : 0;
  }
  /// Largest tension at a damage [Pa].
  template <class V>
  PIOLA_FN V largest_tension(V const& damage) const {
    return tension_ * (1.0 - damage);
  }
  /// Bulking pressure after the strength fell from `before` to `after` [Pa], at a compression m = rho/rho0 - 1.
  PIOLA_FN double bulked(double bulking, double before, double after, double m, double kappa, double mu) const {
    double const lost = (before * before - after * after) / (6 * mu);
    if (!(lost > 0) || !(m > 0) || !(beta_ > 0)) return bulking;
    double const elastic = kappa * m;
    return std::sqrt((elastic + bulking) * (elastic + bulking) + 2 * beta_ * kappa * lost) - elastic;
  }

 private:
  PIOLA_FN double fast(double rate) const { return rate > rate0_ ? 1 + C_ * std::log(rate / rate0_) : 1; }

  double scale_, per_pressure_, tension_;
  double A_, N_, B_, M_, most_, C_, D1_, D2_, beta_, rate0_;
};

}  // namespace piola::inline PIOLA_BACKEND
