// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/records.hpp"
#include "piola/math/symmetric_eigen.hpp"
#include <cmath>

/// Artificial viscosity and artificial stress of one pair.
namespace piola::adaptle::inline PIOLA_BACKEND {

/// Inputs of the viscosity of a pair.
template <class T>
struct ViscousPair {
  T mu;        ///< (7): h v_ba.r / (r.r + 0.01 h^2) where the pair approaches, else zero [m/s]
  T pressure;  ///< (6): Pi = (-alpha c mu + beta mu^2) / rho with means of the pair, in p/rho^2 [m5/(kg s2)]
};

/// zeta rho0 c h of the hourglass damping [Pa s].
PIOLA_FN double damping_of(BodyConstants const& b) { return b.hourglass * b.rho0 * b.c * b.reference_h; }
/// kappa of the hourglass stiffness [Pa].
PIOLA_FN double stiffness_of(BodyConstants const& b) { return b.hourglass_stiffness * b.shear_modulus; }

/// Fraction of the viscosity that remains without compression, to damp noise: of total-Lagrangian particles, which also
/// have hourglass damping, and of Eulerian ones, whose disorder has no other damping.
inline constexpr double compression_floor = 0.05, eulerian_floor = 0.3;

/// |rot v| [1/s].
template <class V>
PIOLA_FN V rotation_of(Mat<3, V> const& L) {
  V const x = L(2, 1) - L(1, 2), y = L(0, 2) - L(2, 0), z = L(1, 0) - L(0, 1);
  return square_root(x * x + y * y + z * z);
}

/// closing: (v_b - v_a).r; c: sum of both speeds of sound, rho: sum of both densities. One division for both quotients.
template <class T>
PIOLA_INLINE_FN ViscousPair<T> viscous_pair(double alpha, double beta, double h, T const& closing, T const& square,
                                            T const& c, T const& rho) {
  T const distance = square + 0.01 * h * h, share = 1.0 / (distance * rho);
  T const mu = h * minimum(closing, T(0.0)) * (rho * share);
  return {mu, (beta * mu - (0.5 * alpha) * c) * mu * (2.0 * (distance * share))};
}

/// Balsara's switch: |div v| / (|div v| + |rot v| + 10^-4 c/h), from the velocity gradient L [1/s].
template <class V>
PIOLA_FN V balsara_factor(Mat<3, V> const& L, std::type_identity_t<V> const& c, double h) {
  V const divergence = trace(L), part = select(divergence < 0.0, -divergence, divergence);
  return part / (part + rotation_of(L) + 1e-4 * c / h);
}

/// How much of a motion is compression, from its velocity gradient L [1/s]: 1 in plane, cylindrical and spherical
/// compression, `floor` in shear, rotation and expansion.
///   f = max(-tr D, 0) / (sqrt(3/2 D':D') + |rot v| + 10^-3 c/h), between the floor and 1
/// D' is the deviator of the rate D. In a plane shock sqrt(3/2 D':D') is |tr D| itself.
template <class V>
PIOLA_FN V compression_factor(Mat<3, V> const& L, std::type_identity_t<V> const& c, double h,
                              std::type_identity_t<V> const& floor) {
  V const divergence = trace(L), mean = divergence / 3.0;
  auto const shrinks = divergence < 0.0;
  if (!any(shrinks)) return floor;
  V square(0.0);
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      V const d = i == j ? L(i, i) - mean : 0.5 * (L(i, j) + L(j, i));
      square += (i == j ? 1.0 : 2.0) * d * d;
    }
  V const f = -divergence / (square_root(1.5 * square) + rotation_of(L) + 1e-3 * c / h);
  return select(shrinks, select(f < floor, floor, select(f > 1.0, V(1.0), f)), floor);
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
