// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/hyperelastic/volumetric_split.hpp"
#include "piola/math/tensor.hpp"
#include <array>
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Nearly incompressible Mooney-Rivlin solid, polyconvex: shear stiffness from F and from its cofactor H.
///   W = zeta (J^(-2/3) F:F - 3) + xi (J^(-2) (H:H)^(3/2) - 3 sqrt(3)) + kappa/2 (J - 1)^2,  2 zeta + 3 sqrt(3) xi = mu
///   S_F = 2 zeta J^(-2/3) F,  S_H = 3 xi J^(-2) (H:H)^(1/2) H                                            (9)
///   S_J = -2/3 zeta J^(-5/3) F:F - 2 xi J^(-3) (H:H)^(3/2) + p,  p = kappa (J - 1)                       (10), (11)
///   P = S_F + S_H x F + S_J H                                                                            (12)
/// (Lee et al. 2016, Section 2.1; example 8.7 has zeta = 0.) Pressure is positive in tension. Valid for J > 0.
struct MooneyRivlin : VolumetricSplit<MooneyRivlin> {
  static constexpr std::string_view name = "mooney_rivlin";
  static constexpr std::string_view about =
      "nearly incompressible Mooney-Rivlin solid, polyconvex, large elastic strain";
  static constexpr std::string_view validity = "rubber, nearly incompressible, J > 0";
  static constexpr bool small_strain = false;
  static constexpr std::array parameters{
      ElasticConstants::parameters[0], ElasticConstants::parameters[1], ElasticConstants::parameters[2],
      Parameter{"c10_fraction", "1",
                "fraction of the shear modulus that F:F carries, the rest is of H:H; 1: neo-Hookean", Interval{0, 1},
                0.0}};

  double zeta;  ///< coefficient of F:F [Pa]
  double xi;    ///< coefficient of (H:H)^(3/2) [Pa]

  /// values: density, Young's modulus, Poisson's ratio, c10_fraction.
  PIOLA_INLINE_FN explicit MooneyRivlin(double const* values)
      : VolumetricSplit(values), zeta(0.5 * values[3] * mu), xi((1 - values[3]) * mu / three_root_three) {}

  using VolumetricSplit::isochoric_energy;
  using VolumetricSplit::stress_with_pressure;
  /// P of F, H and J as unknowns (eq. 12) with the pressure p given.
  template <class T>
  PIOLA_INLINE_FN Mat<3, T> stress_with_pressure(Mat<3, T> const& F, Mat<3, T> const& H, T const& J, T const& p) const {
    T const a = power_minus_third(J), per_J = 1.0 / J, area = contract(H, H);
    T const of_F = (2.0 * zeta) * (a * a), of_H = (3.0 * xi) * (per_J * per_J) * square_root(area);
    T const of_J = p - (1.0 / 3.0) * per_J * (of_F * contract(F, F) + 2.0 * (of_H * area));
    return of_F * F + of_H * tensor_cross(H, F) + of_J * H;
  }
  /// The part of the energy that a change of volume alone does not touch.
  template <class T>
  PIOLA_INLINE_FN T isochoric_energy(Mat<3, T> const& F, Mat<3, T> const& H, T const& J) const {
    T const a = power_minus_third(J), area = contract(H, H);
    return zeta * (a * a * contract(F, F) - 3.0) + xi * (area * square_root(area) / (J * J) - three_root_three);
  }
  /// d2W / dl_1^2, from the squares of the principal stretches [Pa]. With m = l_2^2 + l_3^2, n = (l_2 l_3)^2 the
  /// cofactor term is u^(3/2) / (n l_1^2), u = m l_1^2 + n.
  template <class T>
  PIOLA_FN T modulus(T const& a, T const& b, T const& c) const {
    T const n = b * c, m = b + c, u = m * a + n, root = square_root(u), shear = power_minus_third(a * n);
    T const area = (6.0 * u * u / (a * a) - 9.0 * m * u / a + 3.0 * m * m) / (n * root);
    return kappa * n + zeta * shear * (4.0 / 9.0 + (10.0 / 9.0) * m / a) + xi * area;
  }

 private:
  static constexpr double three_root_three = 5.196152422706632;
};

}  // namespace piola::inline PIOLA_BACKEND
