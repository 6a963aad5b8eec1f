// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include <type_traits>

/// Artificial viscosity of a pair of particles (Monaghan), eqs. (6) and (7) of docs/theory/adaptle.md.
namespace piola::inline PIOLA_BACKEND {

/// Inputs of the viscosity of a pair.
template <class T>
struct ViscousPair {
  T mu;        ///< (7): h v_ba.r / (r.r + 0.01 h^2) where the pair approaches, else zero [m/s]
  T pressure;  ///< (6): Pi = (-alpha c mu + beta mu^2) / rho with means of the pair, in p/rho^2 [m5/(kg s2)]
};

/// Fraction of the viscosity of Eulerian particles, whose disorder has no other damping, that remains without
/// compression.
inline constexpr double eulerian_floor = 0.3;

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

}  // namespace piola::inline PIOLA_BACKEND
