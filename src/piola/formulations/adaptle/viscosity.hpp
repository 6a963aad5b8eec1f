// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/records.hpp"
#include "piola/math/symmetric_eigen.hpp"

/// Artificial viscosity and artificial stress of one pair.
namespace piola::adaptle::inline PIOLA_MACHINE {

/// What the viscosity of a pair needs.
template <class T>
struct ViscousPair {
  T mu;        ///< (7): h v_ba.r / (r.r + 0.01 h^2) where the pair approaches, else zero [m/s]
  T pressure;  ///< (6): Pi = (-alpha c mu + beta mu^2) / rho with means of the pair, in p/rho^2 [m5/(kg s2)]
};

/// zeta rho0 c h of the hourglass damping [Pa s].
PIOLA_FN double damping_of(BodyConstants const& b) { return b.hourglass * b.rho0 * b.c * b.h; }

/// closing: (v_b - v_a).r; c: sum of both speeds of sound, rho: sum of both densities. One division for both quotients.
template <class T>
PIOLA_FN ViscousPair<T> viscous_pair(double alpha, double beta, double h, T const& closing, T const& square, T const& c,
                                     T const& rho) {
  T const distance = square + 0.01 * h * h, share = 1.0 / (distance * rho);
  T const mu = h * minimum(closing, T(0.0)) * (rho * share);
  return {mu, (beta * mu - (0.5 * alpha) * c) * mu * (2.0 * (distance * share))};
}

/// R of Gray, Monaghan and Swift: -epsilon s_k / rho^2 along each principal direction in tension, rotated back. In two
/// dimensions in the plane.
template <int D>
PIOLA_FN SymMat<D> artificial_stress(SymMat<D> const& stress, double rho, double epsilon) {
  SymMat<D> R{};
  double diagonal = stress(0, 0), off = 0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      if (i == j) diagonal = diagonal > stress(i, i) ? diagonal : stress(i, i);
      if (i != j) off += stress(i, j) > 0 ? stress(i, j) : -stress(i, j);
    }
  if (diagonal + off <= 0) return R;  // no eigenvalue is above this (Gershgorin)
  double const factor = -epsilon / (rho * rho);
  Eigen<D> const e = symmetric_eigen(stress);
  for (int k = 0; k < D; ++k) {
    if (!(e.value[k] > 0)) continue;
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) R(i, j) += factor * e.value[k] * e.vector[k][i] * e.vector[k][j];
  }
  return R;
}

}  // namespace piola::adaptle::inline PIOLA_MACHINE
