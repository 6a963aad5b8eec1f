// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/records.hpp"
#include "piola/formulations/common/pair_viscosity.hpp"
#include "piola/math/symmetric_eigen.hpp"

/// Stabilisation of one pair beside its artificial viscosity.
namespace piola::adaptle::inline PIOLA_BACKEND {

/// zeta rho0 c h of the hourglass damping [Pa s].
PIOLA_FN double damping_of(BodyConstants const& b) { return b.hourglass * b.rho0 * b.c * b.reference_h; }
/// kappa of the hourglass stiffness [Pa].
PIOLA_FN double stiffness_of(BodyConstants const& b) { return b.hourglass_stiffness * b.shear_modulus; }

/// Fraction of the viscosity of total-Lagrangian particles, which also have hourglass damping, that remains without
/// compression, to damp noise.
inline constexpr double compression_floor = 0.05;

/// Balsara's switch: |div v| / (|div v| + |rot v| + 10^-4 c/h), from the velocity gradient L [1/s].
template <class V>
PIOLA_FN V balsara_factor(Mat<3, V> const& L, std::type_identity_t<V> const& c, double h) {
  V const divergence = trace(L), part = select(divergence < 0.0, -divergence, divergence);
  return part / (part + rotation_of(L) + 1e-4 * c / h);
}

/// R of Gray, Monaghan and Swift: -epsilon s_k / rho^2 along each principal direction in tension, rotated back. In two
/// dimensions in the plane.
template <int D, class V>
PIOLA_FN SymMat<D, V> artificial_stress(SymMat<D, V> const& stress, std::type_identity_t<V> const& rho,
                                        double epsilon) {
  SymMat<D, V> R;
  for (V& c : R.c) c = V(0.0);
  auto const pulled = eigenvalue_bound(stress) > 0.0;
  if (!any(pulled)) return R;
  V const factor = -epsilon / (rho * rho);
  Eigen<D, V> const e = symmetric_eigen(stress);
  for (int k = 0; k < D; ++k) {
    V const pull = select(pulled && e.value[k] > 0.0, factor * e.value[k], V(0.0));
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) R(i, j) += pull * e.vector[k][i] * e.vector[k][j];
  }
  return R;
}

}  // namespace piola::adaptle::inline PIOLA_BACKEND
