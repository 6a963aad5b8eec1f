// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/formulations/nodal/quadratic.hpp"
#include "piola/formulations/nodal/state.hpp"
#include <type_traits>

namespace piola::nodal {

/// Calls f(integral_constant D).
template <class F>
auto with_dimension(int D, F const& f) {
  if (D == 1) return f(std::integral_constant<int, 1>{});
  if (D == 2) return f(std::integral_constant<int, 2>{});
  return f(std::integral_constant<int, 3>{});
}

/// The one list of particle fields of the nodal formulation, for a body of dimension D; sizes as in quadratic.hpp.
struct Fields : FieldSet {
  /// Numbers of second derivatives, of terms of a quadratic without the constant and with it.
  static int second(int D) { return D * (D + 1) / 2; }
  static int terms(int D) { return D + second(D); }
  static int values(int D) { return 1 + terms(D); }
  /// Strain and viscous stress at every point, and three values of the cell.
  static int viscous_values(int D) { return 2 * points(D) * second(D) + 3; }

  static int points(int D) { return D == 3 ? 4 : 1 << D; }
  static int solid_values(int D) { return HistoryLayout::point(points(D), D); }

  /// `has_solids`: some cell has a solid in rate form. `has_offset`: F starts from given values.
  explicit Fields(int D, bool has_viscosity = false, bool has_solids = false, bool has_offset = false)
      : D_(D), with_viscosity(has_viscosity), with_solids(has_solids), with_offset(has_offset) {}
  int const D_;
  bool const with_viscosity, with_solids, with_offset;

  ListedField V{*this, "CellVolume", "m3", 1, Role::reference};
  ListedField mass{*this, "Mass", "kg", 1, Role::reference};
  ListedField L{*this, "CellSpread", "m", D_* D_, Role::reference};
  ListedField g{*this, "GradientOfSums", "1/m", values(D_) * D_, Role::reference};
  ListedField k{*this, "SecondDerivativeOfSums", "1/m2", terms(D_) * second(D_), Role::reference};
  ListedField own{*this, "SumsOfWeights", "1", values(D_) + D_, Role::reference};
  ListedField X{*this, "ReferencePositionInSpacings", "1", D_, Role::reference};
  ListedField x{*this, "Position", "m", D_, Role::evolved};
  ListedField v{*this, "Velocity", "m/s", D_, Role::evolved};
  ListedField a{*this, "Acceleration", "m/s2", D_, Role::evolved};
  ListedField mu{*this, "GradientCorrection", "1/m", D_, Role::reference};
  ListedField products{*this, "CorrectedPosition", "1", D_* D_, Role::derived};
  ListedField stress{*this, "StressOfSums", "N/m", values(D_) * D_ + D_* D_, Role::derived};
  ListedField F{*this, "DeformationGradient", "1", D_* D_, Role::derived};
  ListedField P{*this, "FirstPiolaStress", "Pa", 9, Role::derived};
  ListedField cell{*this, "CellState", "1", 4, Role::derived};
  ListedField C_measured{*this, "StretchOfLastMeasurement", "1", D_*(D_ + 1) / 2, Role::evolved};
  ListedField change{*this, "ChangeSinceMeasurement", "1", 2, Role::derived};
  ListedField kept{*this, "MotionAtStepStart", "1", 3 * D_ + 1, Role::derived};
  // Allocated only with an initial deformation gradient:
  ListedField offset{*this, "GradientOffset", "1", D_* D_, Role::reference};
  // Allocated only with viscosity:
  ListedField viscous{*this, "ViscousHistory", "1", viscous_values(D_), Role::evolved};
  ListedField viscous_kept{*this, "ViscousHistoryAtStepStart", "1", viscous_values(D_), Role::derived};
  // Allocated only with solids in rate form:
  ListedField history{*this, "SolidHistory", "1", solid_values(D_), Role::evolved};
  ListedField history_kept{*this, "SolidHistoryAtStepStart", "1", solid_values(D_), Role::derived};
};

}  // namespace piola::nodal
