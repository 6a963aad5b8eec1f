// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/pressure_preconditioner.hpp"
#include <vector>

namespace piola::nodal {

/// Motion by the pressure of the bulk modulus, kappa (J - 1) with the mean volume ratio J of a cell, so that pressure
/// waves do not limit steps. The rest of the force kicks at both ends of the step. From x and v, during the step,
///   x' = x + dt v + dt^2/2 a,   v' = v + dt a,   a = -M^-1 D^T (V p),   D = dJ/dx at the midpoint (x + x')/2,
///   p = kappa ((J(x) + J(x'))/2 - 1).
/// With J(x') - J(x) = D (x' - x), exact but for the determinant of the change of F, energy is conserved. The equation
///   p / kappa - (dt/2)^2 D a(p) = J(x) - 1 + dt/2 D v
/// is solved by conjugate gradients, with D at predicted midpoints. On one rank. Theory: docs/theory/nodal.md, section
/// 5; docs/decisions/27.
class ImplicitPressure {
 public:
  /// Throws InputError for bodies that it cannot have: mirror planes, surfaces held by supports, several ranks.
  ImplicitPressure(NodalBody& body, Backend const& backend);

  /// From x and the velocity after the first kick to x and the velocity before the second one. Records a failure if
  /// the iteration does not converge.
  void move(double dt);

  std::size_t bytes() const { return preconditioner_.bytes(); }

  static constexpr int not_converged = 2;  ///< FailureSlot::code

 private:
  using Vector = std::vector<double>;
  Vector change_of_ratio(Vector const& by);
  void accelerate(Vector const& pressure);
  Vector free_accelerations(Vector const& pressure);
  Vector apply(Vector const& pressure);
  double product(Vector const& u, Vector const& w) const;
  bool solve(Vector const& wanted, double accuracy, Vector& pressure);
  bool solve_step(Vector const& x, Vector const& by_velocity, Vector& pressure);
  void keep(Vector const& pressure, Vector const& a);
  Vector ratios() const;

  NodalBody& body_;
  Backend const& backend_;
  PressurePreconditioner preconditioner_;
  double tau_ = 0;      ///< (dt/2)^2 [s2]
  double scale_ = 0;    ///< square of the norm of the right side of the first pass
  int iterations_ = 0;  ///< of the last solution
};

}  // namespace piola::nodal
