// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/materials/hypoelastic_solid.hpp"
#include "piola/math/scalar.hpp"
#include "piola/math/symmetric_eigen.hpp"
#include "piola/math/tensor.hpp"

/// Undamaged stresses of one cell that may fail. Theory: docs/theory/nodal.md, "Failure".
namespace piola::nodal::inline PIOLA_BACKEND {

template <int Points>
struct CellStress {
  SymMat<3> S[Points];    ///< deviators [Pa]
  double spread[Points];  ///< tension of the points over that of the cell [Pa]
  double pressure;        ///< of the cell, positive in compression [Pa]

  /// Stresses in lane l of a group of cells, which has S and spread of its points.
  template <class Cells>
  PIOLA_FN CellStress(Cells const& cells, Lanes const& of_cells, int l) : pressure(lane(of_cells, l)) {
    for (int q = 0; q < Points; ++q) {
      for (int c = 0; c < 6; ++c) S[q].c[c] = lane(cells.S[q].c[c], l);
      spread[q] = lane(cells.spread[q], l);
    }
  }

  /// Root mean square of the tension of the points, see squared_tension; 0 if it cannot be larger than `least` [Pa].
  /// With the mean over the points a crack takes the fracture energy however the strain is spread over them. modulus:
  /// modulus_across_crack.
  PIOLA_FN double tension(double least, double modulus, double kappa, double mu) const {
    SymMat<3> sigma[Points];
    double bound = 0;
    for (int q = 0; q < Points; ++q) {
      for (int c = 0; c < 6; ++c) sigma[q].c[c] = S[q].c[c] + (c < 3 ? spread[q] - pressure : 0);
      bound = maximum(bound, eigenvalue_bound(sigma[q]));
    }
    if (!(bound > 0)) return 0;
    // The energy is a convex function of the principal stresses: it is largest where each is 0 or at its bound.
    double corner[3]{}, most = 0;
    for (double& stress : corner) {
      stress = bound;
      most = maximum(most, squared_tension(corner, modulus, kappa, mu));
    }
    if (!(most > least * least)) return 0;
    double square = 0;
    for (int q = 0; q < Points; ++q)
      square += squared_tension(symmetric_eigen(sigma[q]).value, modulus, kappa, mu) / Points;
    return square_root(square);
  }

  /// Energy of shear and tension per volume, for these moduli [J/m^3].
  PIOLA_FN double shear_and_tension(double kappa, double mu) const {
    double sum = pressure < 0 ? pressure * pressure / (2 * kappa) : 0;
    for (int q = 0; q < Points && mu > 0; ++q) {
      double const mises = von_mises(S[q]);
      sum += mises * mises / (6 * mu * Points);
    }
    return sum;
  }
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
