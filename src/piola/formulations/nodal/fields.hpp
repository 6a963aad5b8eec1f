// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/common/field_list.hpp"
#include <type_traits>

namespace piola::nodal {

/// Calls f(integral_constant D).
template <class F>
auto with_dimension(int D, F const& f) {
  if (D == 1) return f(std::integral_constant<int, 1>{});
  if (D == 2) return f(std::integral_constant<int, 2>{});
  return f(std::integral_constant<int, 3>{});
}

/// Layout of the field `hoop` of axisymmetric bodies: coefficients of the hoop stretch of a cell,
///   F_33 = eta_0 + t_1 eta_1 + t_2 eta_2 at point t,   eta_n = sum_l T_l of_sum(l, n) + r of_radius(n),
/// T the sums of the radial motion, r the radius of the particle; `own`: minus the derivative of eta by r.
struct HoopSums {
  static constexpr std::size_t terms = 5, numbers = 3;
  static constexpr std::size_t of_sum(std::size_t l, std::size_t n) { return l * numbers + n; }
  static constexpr std::size_t own = terms * numbers, of_radius = own + numbers, size = of_radius + numbers;
};

/// Layout of the field `history` of solids in rate form, at the end of the last step.
struct HistoryLayout {
  /// Values of the cell: pressure, positive in compression [Pa]; specific internal energy [J/kg]; viscous pressure of
  /// shocks [Pa].
  enum : int { pressure, energy, shock_pressure, of_cell };
  /// Values of a point, relative to point(q, D).
  enum : int {
    S,                   ///< deviatoric Cauchy stress [Pa], 6 values
    plastic_strain = 6,  ///< equivalent plastic strain
    temperature,         ///< [K]
    damage,              ///< 0 to 1
    plastic_work,        ///< per reference volume [J/m^3]
    spread,              ///< tension over that of the cell [Pa]
    F                    ///< deformation gradient, D x D values; D = 2: and the stretch of the third direction
  };

  static constexpr int point(int q, int D) { return of_cell + q * (F + D * D + (D == 2 ? 1 : 0)); }
};

/// Layout of the field `history` of laws on blocks of points that have a history, at the end of the last step. `count`:
/// values of a point that the law keeps.
struct BlockLawLayout {
  /// Values of the cell: specific internal energy [J/kg]; modulus of pressure waves [Pa]; viscous pressure of shocks
  /// [Pa].
  enum : int { energy, modulus, shock_pressure, of_cell };
  /// Values of a point, relative to point(q, D, count).
  enum : int {
    stress,      ///< of the law in its measure [Pa], up to 9 values
    spread = 9,  ///< tension over that of the cell [Pa]
    F            ///< as in HistoryLayout; then those of the law
  };
  static constexpr int history(int D) { return F + D * D + (D == 2 ? 1 : 0); }
  static constexpr int point(int q, int D, int count) { return of_cell + q * (history(D) + count); }
};

/// Values of a cell that may fail, after its points in the field `history`, relative to Fields::solid_values(D).
struct FailureLayout {
  enum : int {
    condition,        ///< see CellCondition
    softening,        ///< share of tension and shear that is lost, 0 to 1
    largest_stress,   ///< largest tension so far, undamaged, root mean square over the points [Pa]
    fracture_energy,  ///< lost by softening, per reference volume [J/m^3]
    toughness,        ///< factor on the failure strength; constant
    volume_factor,    ///< volume ratio over that of the stored F, after gradients changed
    refitted,         ///< 1: gradients have changed, the stored F is that of the gradients before
    size
  };
};

/// Opening: hides what is behind its particle, else as an intact cell. Broken: softened entirely; carries pressure
/// only, and hides what is behind its particle. Detached: carries nothing, and its particle is in no fit of another
/// cell.
enum class CellCondition : char { intact, opening, broken, detached };

/// A condition as a value of the field `history`, where cells with less than 0.5 carry stress.
constexpr double value_of(CellCondition condition) {
  switch (condition) {
    case CellCondition::intact: return 0;
    case CellCondition::opening: return 0.25;
    case CellCondition::broken: return 1;
    case CellCondition::detached: return 2;
  }
  return 0;
}
constexpr CellCondition condition_of(double value) {
  return value < 0.1   ? CellCondition::intact
         : value < 0.5 ? CellCondition::opening
         : value < 1.5 ? CellCondition::broken
                       : CellCondition::detached;
}

/// Layout of the field `heat` of cells: temperature [K]; conductivity in the reference configuration [W/(m K)], as
/// SymMat<3>.
struct HeatLayout {
  enum : int { temperature, conductivity, size = conductivity + 6 };
};

/// Conditions under which a body has fields beyond those of the elastic motion.
struct FieldNeeds {
  bool viscosity = false;
  bool solids = false;     ///< some cell has a solid in rate form
  int block_history = -1;  ///< most history values of a point by laws on blocks of points; -1: none has a history
  bool failure = false;    ///< cells may fail
  bool converts = false;   ///< cells that fail become Eulerian
  bool offset = false;     ///< F starts from given values
  bool implicit_pressure = false;
  bool axisymmetric = false;
  bool conducts = false;  ///< heat is conducted
};

/// The one list of particle fields of the nodal formulation, and what loops get of them. Memory and checkpoints follow
/// from it. Numbers of components as in quadratic.hpp.
struct Fields {
  /// Numbers of second derivatives, of terms of a quadratic without the constant, of points of a cell.
  static constexpr int second(int D) { return D * (D + 1) / 2; }
  static constexpr int terms(int D) { return D + second(D); }
  static constexpr int points(int D) { return D == 3 ? 4 : 1 << D; }
  /// Strain and viscous stress at every point, and three values of the cell.
  static constexpr int viscous_values(int D) { return 2 * points(D) * second(D) + 3; }
  static constexpr int solid_values(int D) { return HistoryLayout::point(points(D), D); }
  /// Position in `history` of a value of FailureLayout.
  static constexpr int failure_value(int of, int D) { return solid_values(D) + of; }
  int history_values() const {
    if (has.block_history >= 0) return BlockLawLayout::point(points(dimension), dimension, has.block_history);
    return solid_values(dimension) + (has.failure ? int{FailureLayout::size} : 0);
  }
  /// Condition of fields whose memory, if any, is that of NeighbourRecords.
  static constexpr bool in_records = false;

  /// of: owner of the memory; nullptr: none.
  explicit Fields(FieldList* of = nullptr, int D = 3, FieldNeeds const& needs = {})
      : owner(of), dimension(D), has(needs) {}
  FieldList* owner;
  int dimension;
  FieldNeeds has;

  // Reference: volume of the cell; mass; Cholesky factor of the cell's spread times the parity (columns of L: D x D);
  // of lists the matrix k from sums to second derivatives (terms x second); sums of G and K over the neighbours;
  // offset of F over the gradient of positions, from the start.
  ListedRef V{owner, "CellVolume", "m3", 1, Role::reference};
  ListedRef mass{owner, "Mass", "kg", 1, Role::reference};
  ListedRef L{owner, "CellSpread", "m", dimension* dimension, Role::reference};
  ListedRef k{owner,     "SecondDerivativeOfSums", "1/m2", terms(dimension) * second(dimension), Role::reference,
              in_records};
  ListedRef own{owner, "SumsOfGradients", "1", dimension + second(dimension), Role::reference};
  ListedRef X{owner, "ReferencePositionInSpacings", "1", dimension, Role::reference, in_records};
  ListedRef hoop{owner,           "HoopStretchOfSums", "1/m", static_cast<int>(HoopSums::size),
                 Role::reference, has.axisymmetric};
  ListedRef offset{owner, "GradientOffset", "1", dimension* dimension, Role::reference, has.offset};

  // Evolved: position, velocity; acceleration by all forces at x; F^T F at the last measurement of the step; largest
  // change of a strain since, least J now; see HistoryLayout, ViscousHistory.
  ListedRef x{owner, "Position", "m", dimension, Role::evolved};
  ListedRef v{owner, "Velocity", "m/s", dimension, Role::evolved};
  ListedRef a{owner, "Acceleration", "m/s2", dimension, Role::evolved};
  ListedRef C_measured{owner, "MeasuredStretch", "1", second(dimension), Role::evolved};
  ListedRef change{owner, "Change", "1", 2, Role::evolved};
  ListedRef history{owner, "SolidHistory", "1", history_values(), Role::evolved, has.solids || has.block_history >= 0};
  ListedRef viscous{owner, "ViscousHistory", "1", viscous_values(dimension), Role::evolved, has.viscosity};

  // Implicit pressure, in the last step and in the one before: pressure of the bulk modulus, tension positive;
  // acceleration by it.
  ListedRef pressure{owner, "BulkPressure", "Pa", 2, Role::evolved, has.implicit_pressure};
  ListedRef bulk_a{owner, "BulkAcceleration", "m/s2", 2 * dimension, Role::evolved, has.implicit_pressure};

  // Derived, one of them: of lists rows (V Q_i k^T, P_i); of lattices rows (P_i, Q_i).
  ListedRef stress{owner, "StressOfSums", "Pa", dimension*(terms(dimension) + dimension), Role::derived, in_records};
  ListedRef resultants{owner,         "StressResultants", "Pa", dimension*(dimension + second(dimension)),
                       Role::derived, in_records};
  // By Backend::update_output_fields alone, not by steps: gradient at the centroid; mean stress, three-dimensional;
  // energy per volume, mean J, least J, mean stretch of a missing direction.
  ListedRef F{owner, "DeformationGradient", "1", dimension* dimension, Role::derived};
  ListedRef P{owner, "FirstPiolaStress", "Pa", 9, Role::derived};
  ListedRef cell{owner, "CellState", "1", 4, Role::derived};
  // At the start of the step: x, v, a and the least J; histories.
  ListedRef kept{owner, "MotionAtStepStart", "1", 3 * dimension + 1, Role::derived};
  // Implicit pressure: resultants of a unit pressure; volume ratio of the cell, its change, or a pressure; mean
  // velocity of the step.
  ListedRef unit{owner,         "UnitPressureResultants", "1", dimension*(dimension + second(dimension)),
                 Role::derived, has.implicit_pressure};
  ListedRef heat{owner, "CellHeat", "K", HeatLayout::size, Role::derived, has.conducts};
  ListedRef ratio{owner, "CellVolumeRatio", "1", 1, Role::derived, has.implicit_pressure};
  ListedRef mean_v{owner, "MeanVelocity", "m/s", dimension, Role::derived, has.implicit_pressure};
  ListedRef history_kept{owner,         "SolidHistoryAtStepStart",           "1", history_values(),
                         Role::derived, has.solids || has.block_history >= 0};
  ListedRef viscous_kept{owner,        "ViscousHistoryAtStepStart", "1", viscous_values(dimension), Role::derived,
                         has.viscosity};
};

}  // namespace piola::nodal
