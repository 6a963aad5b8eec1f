// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/formulations/nodal/quadratic.hpp"

namespace piola::nodal {

/// The one list of particle fields of the nodal formulation, for a body of dimension D; sizes as in quadratic.hpp.
struct Fields {
  /// Numbers of second derivatives, of terms of a quadratic without the constant and with it.
  static int second(int D) { return D * (D + 1) / 2; }
  static int terms(int D) { return D + second(D); }
  static int values(int D) { return 1 + terms(D); }
  /// Strain and viscous stress at every point, and three numbers of the cell.
  static int viscous_values(int D) { return 2 * (D == 3 ? 4 : 1 << D) * second(D) + 3; }

  explicit Fields(int D)
      : V("CellVolume", "m3", 1, Role::reference),
        mass("Mass", "kg", 1, Role::reference),
        L("CellSpread", "m", D * D, Role::reference),
        g("GradientOfSums", "1/m", values(D) * D, Role::reference),
        k("SecondDerivativeOfSums", "1/m2", terms(D) * second(D), Role::reference),
        own("SumsOfWeights", "1", values(D) + D, Role::reference),
        X("ReferencePositionInSpacings", "1", D, Role::reference),
        x("Position", "m", D, Role::evolved),
        v("Velocity", "m/s", D, Role::evolved),
        a("Acceleration", "m/s2", D, Role::evolved),
        mu("GradientCorrection", "1/m", D, Role::reference),
        products("CorrectedPosition", "1", D * D, Role::derived),
        stress("StressOfSums", "N/m", values(D) * D + D * D, Role::derived),
        F("DeformationGradient", "1", D * D, Role::derived),
        P("FirstPiolaStress", "Pa", 9, Role::derived),
        cell("CellState", "1", 4, Role::derived),
        C_measured("StretchOfLastMeasurement", "1", D * (D + 1) / 2, Role::evolved),
        change("ChangeSinceMeasurement", "1", 2, Role::derived),
        kept("MotionAtStepStart", "1", 3 * D + 1, Role::derived),
        viscous("ViscousHistory", "1", viscous_values(D), Role::evolved),
        viscous_kept("ViscousHistoryAtStepStart", "1", viscous_values(D), Role::derived) {}

  bool with_viscosity = false;
  Field V, mass, L, g, k, own;
  Field X, x, v, a;
  Field mu, products, stress;  ///< with X and x, what sweeps read of neighbours
  Field F, P, cell, C_measured, change, kept;
  Field viscous, viscous_kept;  ///< allocated where there is viscosity

  template <class Visit>
  void each(Visit&& visit) {
    for (Field* f : {&V, &mass, &L, &g, &k, &own, &X, &x, &v, &a, &mu, &products, &stress, &F, &P, &cell, &C_measured,
                     &change, &kept})
      visit(*f);
    if (with_viscosity)
      for (Field* f : {&viscous, &viscous_kept}) visit(*f);
  }
};

}  // namespace piola::nodal
