// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/plastic/adiabatic_heating.hpp"
#include "piola/materials/plastic/cowper_symonds.hpp"
#include "piola/materials/plastic/hardening_curve.hpp"
#include "piola/math/lanes.hpp"
#include <cmath>
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Isotropic hardening: the yield stress is a curve over the plastic strain, times the factor of Cowper and Symonds.
/// The law of this name has a straight curve, sy0 + Ep ep with the plastic modulus Ep = d sy / d ep. Other laws derive
/// from it and bring another curve.
class IsotropicHardening {
 public:
  static constexpr std::string_view name = "isotropic_hardening";
  static constexpr std::string_view about = "elastic solid in rate form whose yield stress grows with plastic strain";
  static constexpr bool yields = true, thermal = false, homologous = false, brittle = false, pressed = false;
  static constexpr bool has_rate_dependence = true;  ///< the parameters end with those of CowperSymonds
  static constexpr std::array parameters{
      Parameter{"yield_stress", "Pa", "von Mises stress at first yield", positive},
      Parameter{"hardening_modulus", "Pa", "d (yield stress) / d (plastic strain)", not_negative},
      CowperSymonds::parameters[0], CowperSymonds::parameters[1]};

  PIOLA_FN IsotropicHardening(double const* v, Heat const&)
      : IsotropicHardening(HardeningCurve{.yield = v[0], .modulus = v[1]}, v + 2) {}
  /// Yield stress of a state at a plastic strain rate [1/s] [Pa].
  PIOLA_FN double yield_stress(FlowState const& s, double rate) const {
    return curve_.at(s.plastic_strain).value * rate_.factor(rate);
  }
  /// Plastic strain of a step of `dt` [s] whose trial stress has the von Mises stress `mises` [Pa]. dt = 0: no effect
  /// of rate.
  PIOLA_FN double increment(double mises, double three_mu, FlowState const& s, double dt, double = 0) const {
    double const start = curve_.at(s.plastic_strain).value;
    if (!(mises > start)) return 0;
    if (rate_.counts() && dt > 0) return increment_by_rate(mises, three_mu, s.plastic_strain, start, dt);
    if (curve_.straight()) return (mises - start) / (three_mu + curve_.modulus);
    auto const miss = [&](double x) {
      Sloped const yield = curve_.at(s.plastic_strain + x);
      return Sloped{mises - three_mu * x - yield.value, -(three_mu + yield.slope)};
    };
    return falling_root(miss, 0, (mises - start) / three_mu, 1e-15 * mises);
  }

  /// Whether increments() has the plastic strain in closed form.
  PIOLA_FN bool closed_form() const { return curve_.straight() && !rate_.counts(); }
  /// As increment(), for several points.
  template <class V>
  PIOLA_FN V increments(V const& mises, double three_mu, V const& plastic_strain) const {
    V const yield = curve_.yield + curve_.modulus * plastic_strain;
    return select(mises > yield, (mises - yield) / (three_mu + curve_.modulus), V(0.0));
  }
  /// Lower bound of the yield stress over all states [Pa].
  template <class V>
  PIOLA_FN V least_yield_stress(V const&) const {
    return V(curve_.at(0).value);
  }

 protected:
  /// rate: values of CowperSymonds.
  PIOLA_FN IsotropicHardening(HardeningCurve const& curve, double const* rate) : curve_(curve), rate_(rate) {}

 private:
  /// The increment with the effect of rate. The unknown is g = (rate/C)^(1/p), in which the equation has no infinite
  /// slope at rate 0. Both bounds of g leave out a part of the resistance to flow.
  PIOLA_FN double increment_by_rate(double mises, double three_mu, double strain, double start, double dt) const {
    double const at_c = rate_.C * dt, over = mises - start;
    double const by_stress = over / start, by_strain = std::pow(over / (three_mu * at_c), 1 / rate_.p);
    auto const miss = [&](double g) {
      double const x = at_c * std::pow(g, rate_.p);
      Sloped const yield = curve_.at(strain + x);
      double const per_strain = three_mu + yield.slope * (1 + g);
      return Sloped{over - three_mu * x - (yield.value - start) - yield.value * g,
                    -(per_strain * rate_.p * x / g + yield.value)};
    };
    double const g = falling_root(miss, 0, by_stress < by_strain ? by_stress : by_strain, 1e-15 * mises);
    return at_c * std::pow(g, rate_.p);
  }

  HardeningCurve curve_;
  CowperSymonds rate_;
};

}  // namespace piola::inline PIOLA_BACKEND
