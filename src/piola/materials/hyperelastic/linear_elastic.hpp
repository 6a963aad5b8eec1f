// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/hyperelastic/volumetric_split.hpp"
#include "piola/math/tensor.hpp"
#include <string_view>

namespace piola::inline PIOLA_BACKEND {

/// Linear elasticity in the small strain e = (F + F^T)/2 - I.
///   W = mu (e:e - (tr e)^2/3) + kappa/2 (tr e)^2
///   P = mu (F + F^T - 2/3 tr F I) + p I,   p = kappa (tr F - 3)
/// (Lee et al. 2016, examples 8.1 and 8.2.) Not objective under large rotation: for small displacement only.
struct LinearElastic : VolumetricSplit<LinearElastic> {
  static constexpr std::string_view name = "linear_elastic";
  static constexpr std::string_view about = "linear elasticity, small strain and small rotation";
  static constexpr std::string_view validity =
      "strains below 0.02 and rotations below 0.05 rad. Beyond, the stress is wrong by about strain plus rotation, "
      "Cauchy's stress is not symmetric, and a rotation by r counts as a strain of r^2/2; a run under jst_sph or "
      "nodal warns of it. For more take saint_venant_kirchhoff or neo_hookean";
  static constexpr bool small_strain = true;
  using VolumetricSplit::VolumetricSplit;

  using VolumetricSplit::isochoric_energy;
  using VolumetricSplit::stress_with_pressure;
  /// P with the pressure p given, for schemes that do not take it from this F alone. In small strain H is the identity
  /// and J its own volume ratio 1 + tr e, whatever is given.
  template <class T>
  PIOLA_INLINE_FN Mat<3, T> stress_with_pressure(Mat<3, T> const& F, Mat<3, T> const&, T const&, T const& p) const {
    Mat<3, T> P = mu * (F + transpose(F));
    T const diagonal = p - (2.0 / 3.0) * mu * trace(F);
    for (int i = 0; i < 3; ++i) P(i, i) = P(i, i) + diagonal;
    return P;
  }
  /// The part of the energy that a change of volume alone does not touch.
  template <class T>
  PIOLA_INLINE_FN T isochoric_energy(Mat<3, T> const& F, Mat<3, T> const&, T const&) const {
    Mat<3, T> const e = 0.5 * (F + transpose(F)) - identity<3, T>();
    T const volume = trace(e);
    return mu * (contract(e, e) - (1.0 / 3.0) * (volume * volume));
  }
  /// D : d = lambda tr(d) 1 + 2 mu d: the rate of the Cauchy stress in a frame that turns with the material, for a rate
  /// of deformation d (Serroukh and Mabssout 2022, eq. 2) [Pa/s].
  template <class T>
  PIOLA_INLINE_FN SymMat<3, T> stress_rate(SymMat<3, T> const& d) const {
    SymMat<3, T> r;
    T const volume = lambda * (d.c[0] + d.c[1] + d.c[2]);
    for (int c = 0; c < 6; ++c) r.c[c] = 2 * mu * d.c[c];
    for (int c = 0; c < 3; ++c) r.c[c] = r.c[c] + volume;
    return r;
  }
  /// Energy per volume that a stress stores, 1/2 sigma : D^-1 : sigma [J/m^3].
  template <class T>
  PIOLA_INLINE_FN T energy_of_stress(SymMat<3, T> const& s) const {
    T const sum = s.c[0] + s.c[1] + s.c[2];
    T square = s.c[0] * s.c[0] + s.c[1] * s.c[1] + s.c[2] * s.c[2];
    for (int c = 3; c < 6; ++c) square = square + 2.0 * (s.c[c] * s.c[c]);
    return (square - lambda / (3 * lambda + 2 * mu) * (sum * sum)) / (4 * mu);
  }
  /// d2W / dl_1^2 [Pa]: does not depend on the stretches.
  template <class T>
  PIOLA_FN T modulus(T const&, T const&, T const&) const {
    return T(lambda + 2 * mu);
  }
};

}  // namespace piola::inline PIOLA_BACKEND
