// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/records.hpp"
#include "piola/math/symmetric_eigen.hpp"

/// Artificial viscosity and artificial stress of one pair.
namespace piola::adaptle::inline PIOLA_MACHINE {

/// mu_ab of a pair, zero where it does not approach: h v_ba.r / (r.r + 0.01 h^2)   (7)
template <class T>
PIOLA_FN T approach_of(T const& closing, T const& square, double h) {
  return h * minimum(closing, T(0.0)) / (square + 0.01 * h * h);
}

/// Pi_ab = (-alpha c mu + beta mu^2) / rho with means of the pair, in p/rho^2 [m5/(kg s2)]   (6)
template <class T>
PIOLA_FN T viscous_pressure(double alpha, double beta, T const& mu, T const& c, T const& rho) {
  return (beta * mu - alpha * c) * mu / rho;
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
