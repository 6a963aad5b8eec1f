// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/base/parameter.hpp"
#include <array>
#include <cmath>
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// The word `eos` of a solid, in the order of the equations of state in hypoelastic_registry.hpp.
inline constexpr std::array<std::string_view, 5> eos_words{"elastic", "stiffened_gas", "mie_grueneisen", "polynomial",
                                                           "jwl"};

/// Numbers of all equations of state. A solid reads them all; its equation of state takes its own.
struct EosValues {
  static constexpr Condition with_gas{"eos", "stiffened_gas"};
  static constexpr Condition with_grueneisen{"eos", "mie_grueneisen"};
  static constexpr Condition with_polynomial{"eos", "polynomial"};
  static constexpr Condition with_jwl{"eos", "jwl"};
  static constexpr std::array parameters{
      Parameter{"bulk_sound_speed", "m/s", "c0, sound speed of the pressure alone at rest", positive, 0,
                "sqrt(K/density)", Condition{"eos", "stiffened_gas", "mie_grueneisen"}},
      Parameter{"adiabatic_exponent",
                "1",
                "gamma0 of the stiffened gas",
                Interval{1, unbounded, false, true},
                no_default,
                {},
                with_gas},
      Parameter{"grueneisen_gamma", "1", "Grueneisen's gamma0 at rest", not_negative, no_default, {}, with_grueneisen},
      Parameter{"grueneisen_slope", "1", "a, change of gamma0 with rho/rho0 - 1", any_value, 0, {}, with_grueneisen},
      Parameter{"hugoniot_s1",
                "1",
                "s1, slope of shock speed over particle speed",
                not_negative,
                no_default,
                {},
                with_grueneisen},
      Parameter{"hugoniot_s2", "1", "s2, quadratic coefficient of the shock speed", any_value, 0, {}, with_grueneisen},
      Parameter{"hugoniot_s3", "1", "s3, cubic coefficient of the shock speed", any_value, 0, {}, with_grueneisen},
      Parameter{"c1", "Pa", "C1 of the polynomial, the bulk modulus", positive, 0, "K of E and nu", with_polynomial},
      Parameter{"c2", "Pa", "C2 of the polynomial", any_value, 0, {}, with_polynomial},
      Parameter{"c3", "Pa", "C3 of the polynomial", any_value, 0, {}, with_polynomial},
      Parameter{"c4", "1", "C4 of the polynomial, times the energy", any_value, 0, {}, with_polynomial},
      Parameter{"c5", "1", "C5 of the polynomial, times the energy", any_value, 0, {}, with_polynomial},
      Parameter{"c6", "1", "C6 of the polynomial, times the energy", any_value, 0, {}, with_polynomial},
      Parameter{"jwl_a", "Pa", "A of the gases of an explosive", positive, no_default, {}, with_jwl},
      Parameter{"jwl_b", "Pa", "B of the gases of an explosive", any_value, no_default, {}, with_jwl},
      Parameter{"jwl_r1", "1", "R1, times the volume ratio, in the exponent of A", positive, no_default, {}, with_jwl},
      Parameter{"jwl_r2", "1", "R2, times the volume ratio, in the exponent of B", positive, no_default, {}, with_jwl},
      Parameter{"jwl_omega", "1", "omega, Grueneisen's gamma of the gases", positive, no_default, {}, with_jwl},
      Parameter{"detonation_energy",
                "J/m^3",
                "E0, energy per volume of the explosive, which its gases start with",
                positive,
                no_default,
                {},
                with_jwl},
      Parameter{"detonation_speed", "m/s", "speed of the detonation front", positive, no_default, {}, with_jwl}};

  double rho0;          ///< reference density [kg/m^3]
  double kappa;         ///< bulk modulus of Young's modulus and Poisson's ratio [Pa]
  double c0;            ///< [m/s]
  double exponent;      ///< gamma0 of the stiffened gas
  double gamma, slope;  ///< gamma0 and a of Mie and Grueneisen
  double s1, s2, s3;    ///< shock speed
  double c1, c2, c3;    ///< [Pa]
  double c4, c5, c6;
  double a, b;           ///< of Jones, Wilkins and Lee [Pa]
  double r1, r2, omega;  ///< the same
  double detonation;     ///< energy of the explosive [J/m^3]
  double front;          ///< speed of detonation [m/s]

  /// v: values in the order of `parameters`.
  PIOLA_FN EosValues(double density, double bulk_modulus, double const* v)
      : rho0(density),
        kappa(bulk_modulus),
        c0(v[0] > 0 ? v[0] : std::sqrt(bulk_modulus / density)),
        exponent(v[1]),
        gamma(v[2]),
        slope(v[3]),
        s1(v[4]),
        s2(v[5]),
        s3(v[6]),
        c1(v[7] > 0 ? v[7] : bulk_modulus),
        c2(v[8]),
        c3(v[9]),
        c4(v[10]),
        c5(v[11]),
        c6(v[12]),
        a(v[13]),
        b(v[14]),
        r1(v[15]),
        r2(v[16]),
        omega(v[17]),
        detonation(v[18]),
        front(v[19]) {}
};

}  // namespace piola::inline PIOLA_BACKEND
