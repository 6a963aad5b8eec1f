// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/plastic/adiabatic_heating.hpp"
#include "piola/math/root.hpp"
#include <cmath>
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Flow stress of Steinberg, Cochran and Guinan (J. Appl. Phys. 51, 1980, pp. 1498-1504), for rates above 1e5 /s, where
/// it no longer depends on the rate:
///   sy = min(Y0 (1 + beta (ep + ei))^n, Ymax) G/G0,   G/G0 = 1 + b p / eta^(1/3) - h (T - Tr),   eta = rho/rho0,
/// between 0 and the melting temperature, above which it is 0:
///   Tm = Tm0 exp(2 a (1 - 1/eta)) eta^(2 (gamma0 - a - 1/3)).
/// Of the elastic rate the shear modulus stays G0 (docs/decisions/06-materials.md).
/// The increment solves mises - 3 mu dep = sy(ep + dep), with pressure, density and temperature of the start of the
/// step.
class SteinbergGuinan {
 public:
  static constexpr std::string_view name = "steinberg_guinan";
  static constexpr std::string_view about =
      "elastic solid in rate form, flow stress by strain, pressure and temperature (Steinberg-Cochran-Guinan)";
  static constexpr bool yields = true, thermal = true, homologous = false, brittle = false, pressed = true;
  static constexpr std::array parameters{
      Parameter{"yield_stress", "Pa", "Y0, flow stress at first yield", positive},
      Parameter{"strain_factor", "1", "beta of (1 + beta (ep + ei))^n", not_negative, 0},
      Parameter{"hardening_exponent", "1", "n of (1 + beta (ep + ei))^n", Interval{0, 1}, 1},
      Parameter{"earlier_plastic_strain", "1", "ei, of the material before the run", not_negative, 0},
      Parameter{"largest_yield_stress", "Pa", "Ymax, of hardening", positive, unbounded, "no limit"},
      Parameter{"pressure_coefficient", "1/Pa", "b = (dG/dp)/G0, of pressure over eta^(1/3)", not_negative, 0},
      Parameter{"temperature_coefficient", "1/K", "h = -(dG/dT)/G0", not_negative, 0},
      Parameter{"melting_at_rest", "K", "Tm0, melting temperature at rest", positive, unbounded, "none"},
      Parameter{"melting_slope", "1", "a of the melting temperature", not_negative, 0},
      Parameter{"melting_gamma", "1", "gamma0 of the melting temperature", not_negative, 1.0 / 3}};

  PIOLA_FN SteinbergGuinan(double const* v, Heat const& heat)
      : y0_(v[0]),
        beta_(v[1]),
        n_(v[2]),
        earlier_(v[3]),
        most_(v[4]),
        b_(v[5]),
        h_(v[6]),
        melting_(v[7]),
        a_(v[8]),
        gamma_(v[9]),
        reference_(heat.reference) {}

  /// Y0 (1 + beta (ep + ei))^n, at most Ymax [Pa].
  PIOLA_FN double hardened(double strain) const {
    double const grown = y0_ * std::pow(1 + beta_ * (strain + earlier_), n_);
    return grown < most_ ? grown : most_;
  }
  /// G/G0, not below 0. pressure: positive in compression [Pa]; compression: rho/rho0; temperature [K].
  PIOLA_FN double stiffness(double pressure, double compression, double temperature) const {
    double const ratio = 1 + b_ * pressure / std::cbrt(compression) - h_ * (temperature - reference_);
    return ratio > 0 ? ratio : 0;
  }
  /// Melting temperature at a compression rho/rho0 [K].
  PIOLA_FN double melting(double compression) const {
    if (!(melting_ < unbounded)) return unbounded;
    return melting_ * std::exp(2 * a_ * (1 - 1 / compression)) * std::pow(compression, 2 * (gamma_ - a_ - 1.0 / 3));
  }
  /// Yield stress of a state [Pa]; the rate does not count.
  PIOLA_FN double yield_stress(FlowState const& s, double) const { return hardened(s.plastic_strain) * softened(s); }
  /// Plastic strain of a step whose trial stress has the von Mises stress `mises` [Pa].
  PIOLA_FN double increment(double mises, double three_mu, FlowState const& s, double, double = 0) const {
    double const soft = softened(s), start = hardened(s.plastic_strain) * soft;
    if (!(mises > start)) return 0;
    auto const miss = [&](double x) {
      double const strain = s.plastic_strain + x, yield = hardened(strain);
      double const slope = yield < most_ ? n_ * beta_ * yield / (1 + beta_ * (strain + earlier_)) : 0;
      return Sloped{mises - three_mu * x - yield * soft, -(three_mu + slope * soft)};
    };
    return falling_root(miss, 0, (mises - start) / three_mu, 1e-15 * mises);
  }

 private:
  PIOLA_FN double softened(FlowState const& s) const {
    if (s.temperature >= melting(s.compression)) return 0;
    return stiffness(s.pressure, s.compression, s.temperature);
  }

  double y0_, beta_, n_, earlier_, most_, b_, h_, melting_, a_, gamma_, reference_;
};

}  // namespace piola::inline PIOLA_BACKEND
