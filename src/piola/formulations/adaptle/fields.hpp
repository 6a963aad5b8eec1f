// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/common/field_list.hpp"

namespace piola::adaptle {

/// Optional features of a case that need additional fields.
struct FieldNeeds {
  bool lagrangian = false;    ///< some particle has a deformation gradient
  bool kernel_sums = false;   ///< some particle is lagrangian, and its sums store the kernel
  bool thickness = false;     ///< in plane stress, and of axisymmetric bodies
  bool axisymmetric = false;  ///< bodies of revolution
  bool touching = false;      ///< several bodies, or rigid shapes
};

/// Components of Fields::contact.
struct ContactSum {
  static constexpr int power = 0,  ///< of contact forces on half the relative velocities [W]
      stiffness = 1,               ///< [N/m]
      overlap = 2,                 ///< largest fraction of the stand-off distance used by a contact
      closing = 3,                 ///< fastest approach of particles of other bodies within the search distance, over
                                   ///< dp [1/s]
      size = 4;
};

/// A field of the list, with access for set-up and observers.
struct ParticleField : ListedRef {
  using ListedRef::ListedRef;
  double& at(Index i, int c = 0) const { return value_at(*this, i, c); }
};

/// The one list of AdapTLE's particle fields, for all bodies of a run together, by slot, and what loops get of them.
/// Memory, checkpoints and migration follow from it. Vectors and tensors are three-dimensional; symmetric ones in the
/// order of SymMat.
struct Fields {
  /// of: owner of the memory; nullptr: none.
  explicit Fields(FieldList* of = nullptr, FieldNeeds const& needs = {}) : owner(of), has(needs) {}
  FieldList* owner;
  FieldNeeds has;

  /// Whether the case has the field.
  static bool holds(FieldRef const& field) { return field.data != nullptr; }
  /// Weight of a neighbour in sums over reference neighbours: the planar volume.
  ParticleField const& weight() const { return holds(area) ? area : volume; }

  ParticleField X{owner, "ReferencePosition", "m", 3, Role::reference};
  ParticleField volume{owner, "Volume", "m3", 1, Role::reference};  ///< of axisymmetric bodies that of the ring
  /// Section of a ring: volume over 2 pi R.
  ParticleField area{owner, "Area", "m2", 1, Role::reference, has.axisymmetric};
  ParticleField mass{owner, "Mass", "kg", 1, Role::reference};

  ParticleField x{owner, "Position", "m", 3, Role::evolved};
  ParticleField v{owner, "Velocity", "m/s", 3, Role::evolved};
  ParticleField S{owner, "StressDeviator", "Pa", 6, Role::evolved};
  ParticleField rho{owner, "Density", "kg/m3", 1, Role::evolved};
  ParticleField energy{owner, "InternalEnergy", "J", 1, Role::evolved};
  ParticleField plastic_strain{owner, "EquivalentPlasticStrain", "1", 1, Role::evolved};
  ParticleField temperature{owner, "Temperature", "K", 1, Role::evolved};
  ParticleField damage{owner, "Damage", "1", 1, Role::evolved};
  ParticleField plastic_work{owner, "PlasticWork", "J/m3", 1, Role::evolved};
  /// Volume over that in the plane: in plane stress, over the initial one; of axisymmetric bodies the length of the
  /// circle [m].
  ParticleField thickness{owner, "Thickness", "1", 1, Role::evolved, has.thickness};
  /// Factor on alpha and beta of the switch of the viscosity.
  ParticleField viscosity{owner, "ViscosityFactor", "1", 1, Role::evolved};
  /// 0: total-Lagrangian, 1: Eulerian, between: blended.
  ParticleField phi{owner, "KernelType", "1", 1, Role::evolved};
  /// 0: deleted, carries no stress.
  ParticleField active{owner, "Alive", "1", 1, Role::evolved};
  /// Fraction of shear and tension that a failed particle has released.
  ParticleField released{owner, "Released", "1", 1, Role::evolved};
  /// Pressure by bulking of broken material.
  ParticleField bulking{owner, "BulkingPressure", "Pa", 1, Role::evolved};
  // Rates of the last step, from which the next one predicts half time.
  ParticleField a{owner, "Acceleration", "m/s2", 3, Role::evolved};
  ParticleField S_rate{owner, "StressDeviatorRate", "Pa/s", 6, Role::evolved};
  ParticleField rho_rate{owner, "DensityRate", "kg/(m3 s)", 1, Role::evolved};
  ParticleField energy_rate{owner, "InternalEnergyRate", "W", 1, Role::evolved};
  ParticleField thickness_rate{owner, "ThicknessRate", "1/s", 1, Role::evolved, has.thickness};
  /// Von Mises stress at the end of the last plastic step; 0: the next prediction evaluates the law.
  ParticleField flow{owner, "FlowStress", "Pa", 1, Role::evolved};

  /// 1: the ring has crossed the axis in the first half of the step, and was turned back.
  ParticleField turned{owner, "TurnedBack", "1", 1, Role::derived, has.axisymmetric};

  // Half time.
  ParticleField v_half{owner, "VelocityOfHalfTime", "m/s", 3, Role::derived};
  ParticleField S_half{owner, "StressDeviatorOfHalfTime", "Pa", 6, Role::derived};
  ParticleField thickness_half{owner, "ThicknessOfHalfTime", "1", 1, Role::derived, has.thickness};
  ParticleField volume_half{owner, "VolumeOfHalfTime", "m3", 1, Role::derived};
  ParticleField rho_half{owner, "DensityOfHalfTime", "kg/m3", 1, Role::derived};
  ParticleField pressure{owner, "PressureOfHalfTime", "Pa", 1, Role::derived};  ///< positive in compression
  ParticleField c{owner, "WaveSpeedOfHalfTime", "m/s", 1, Role::derived};
  ParticleField F{owner, "DeformationGradient", "1", 9, Role::derived, has.lagrangian};
  ParticleField F_rate{owner, "DeformationGradientRate", "1/s", 9, Role::derived, has.lagrangian};
  /// Largest |x_b - x_a - F_a (X_b - X_a)| / material h over Eulerian reference neighbours b; -1: no F.
  ParticleField gap{owner, "Gap", "1", 1, Role::derived, has.lagrangian};

  // Sums over reference neighbours and over contacts.
  ParticleField force{owner, "Force", "N", 3, Role::derived, has.lagrangian || has.touching};
  ParticleField heat{owner, "Heat", "W", 1, Role::derived, has.lagrangian};
  /// Power that the hourglass stiffness stores.
  ParticleField hourglass{owner, "HourglassPower", "W", 1, Role::derived, has.lagrangian};
  /// Largest |mu_ab| of the viscosity.
  ParticleField compression{owner, "FastestCompression", "m/s", 1, Role::derived, has.lagrangian};
  /// In the order of ContactSum.
  ParticleField contact{owner, "ContactSums", "1", ContactSum::size, Role::derived, has.touching};

  /// (1 - phi) V0 P of axisymmetric bodies in the half section, row by row.
  ParticleField section_stress{owner, "SectionStress", "J", 4, Role::derived, has.axisymmetric&& has.lagrangian};

  // Constants of the sums over reference neighbours, with s = -W'(r)/r and r = X_b - X_a.
  /// Inverse of sum_b V0_b s r (x) r, symmetric, of D dimensions; not for the published equations.
  ParticleField K{owner, "GradientCorrection", "1", 6, Role::reference, has.lagrangian};
  /// sum_b V0_b s r over neighbours that are not deleted.
  ParticleField gradient_sum{owner, "GradientSum", "1/m", 3, Role::reference, has.lagrangian};
  /// sum_b V0_b W over neighbours that are not deleted.
  ParticleField kernel_sum{owner, "KernelSum", "1", 1, Role::reference, has.kernel_sums};
  /// N over S of the published gradient N (s r - G W). S: sum_b V0_b W over all neighbours and the particle itself.
  ParticleField N{owner, "FoldedCorrection", "1", 9, Role::reference, has.kernel_sums};
  /// G of the published gradient: sum_b V0_b s r over all neighbours, over S.
  ParticleField gradient_mean{owner, "KernelGradientMean", "1/m", 3, Role::reference, has.kernel_sums};
};

}  // namespace piola::adaptle
