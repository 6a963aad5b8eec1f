// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/formulations/adaptle/state.hpp"

namespace piola::adaptle {

/// The one list of AdapTLE's particle fields, for all bodies of a run together, by slot. Vectors and tensors are
/// three-dimensional; symmetric ones in the order of SymMat.
struct Fields : FieldSet {
  ListedField X{*this, "ReferencePosition", "m", 3, Role::reference};
  ListedField volume{*this, "Volume", "m3", 1, Role::reference};
  ListedField mass{*this, "Mass", "kg", 1, Role::reference};

  ListedField x{*this, "Position", "m", 3, Role::evolved};
  ListedField v{*this, "Velocity", "m/s", 3, Role::evolved};
  ListedField S{*this, "StressDeviator", "Pa", 6, Role::evolved};
  ListedField rho{*this, "Density", "kg/m3", 1, Role::evolved};
  ListedField energy{*this, "InternalEnergy", "J", 1, Role::evolved};
  ListedField plastic_strain{*this, "EquivalentPlasticStrain", "1", 1, Role::evolved};
  ListedField temperature{*this, "Temperature", "K", 1, Role::evolved};
  ListedField damage{*this, "Damage", "1", 1, Role::evolved};
  ListedField plastic_work{*this, "PlasticWork", "J/m3", 1, Role::evolved};
  ListedField thickness{*this, "Thickness", "1", 1, Role::evolved};
  ListedField viscosity{*this, "ViscosityFactor", "1", 1, Role::evolved};
  ListedField phi{*this, "KernelType", "1", 1, Role::evolved};
  ListedField active{*this, "Alive", "1", 1, Role::evolved};
  ListedField released{*this, "Released", "1", 1, Role::evolved};
  ListedField bulking{*this, "BulkingPressure", "Pa", 1, Role::evolved};
  // Rates of the last step, from which the next one predicts half time.
  ListedField a{*this, "Acceleration", "m/s2", 3, Role::evolved};
  ListedField S_rate{*this, "StressDeviatorRate", "Pa/s", 6, Role::evolved};
  ListedField rho_rate{*this, "DensityRate", "kg/(m3 s)", 1, Role::evolved};
  ListedField energy_rate{*this, "InternalEnergyRate", "W", 1, Role::evolved};
  ListedField thickness_rate{*this, "ThicknessRate", "1/s", 1, Role::evolved};
  ListedField flow{*this, "FlowStress", "Pa", 1, Role::evolved};

  // Half time.
  ListedField v_half{*this, "VelocityOfHalfTime", "m/s", 3, Role::derived};
  ListedField S_half{*this, "StressDeviatorOfHalfTime", "Pa", 6, Role::derived};
  ListedField thickness_half{*this, "ThicknessOfHalfTime", "1", 1, Role::derived};
  ListedField volume_half{*this, "VolumeOfHalfTime", "m3", 1, Role::derived};
  ListedField rho_half{*this, "DensityOfHalfTime", "kg/m3", 1, Role::derived};
  ListedField pressure{*this, "PressureOfHalfTime", "Pa", 1, Role::derived};
  ListedField c{*this, "WaveSpeedOfHalfTime", "m/s", 1, Role::derived};
  ListedField F{*this, "DeformationGradient", "1", 9, Role::derived};
  ListedField F_rate{*this, "DeformationGradientRate", "1/s", 9, Role::derived};
  ListedField gap{*this, "Gap", "1", 1, Role::derived};

  // Sums over reference neighbours and over contacts.
  ListedField force{*this, "Force", "N", 3, Role::derived};
  ListedField heat{*this, "Heat", "W", 1, Role::derived};
  ListedField hourglass{*this, "HourglassPower", "W", 1, Role::derived};
  ListedField compression{*this, "FastestCompression", "m/s", 1, Role::derived};
  ListedField contact{*this, "ContactSums", "1", ContactSum::size, Role::derived};

  // Constants of the sums over reference neighbours.
  ListedField K{*this, "GradientCorrection", "1", 6, Role::reference};
  ListedField gradient_sum{*this, "GradientSum", "1/m", 3, Role::reference};
  ListedField kernel_sum{*this, "KernelSum", "1", 1, Role::reference};
  ListedField N{*this, "FoldedCorrection", "1", 9, Role::reference};
  ListedField gradient_mean{*this, "KernelGradientMean", "1/m", 3, Role::reference};

  /// Optional features of a case that need additional fields.
  struct FieldRequirements {
    bool lagrangian = false;    ///< some particle has a deformation gradient
    EquationSet equations;      ///< of the sums over reference neighbours
    bool plane_stress = false;  ///< variable thickness
    bool touching = false;      ///< several bodies, or rigid shapes
  };
  bool wants(Field const& field, FieldRequirements const& needs) const {
    auto const is_one_of = [&](auto const&... some) { return (... || (&field == &some)); };
    if (is_one_of(F, F_rate, gap, heat, hourglass, compression, K, gradient_sum)) return needs.lagrangian;
    if (is_one_of(force)) return needs.lagrangian || needs.touching;
    if (is_one_of(kernel_sum, N, gradient_mean)) return needs.lagrangian && needs.equations.stores_kernel();
    if (is_one_of(thickness, thickness_rate, thickness_half)) return needs.plane_stress;
    if (is_one_of(contact)) return needs.touching;
    return true;
  }
  void allocate(Index particles, FieldRequirements const& needs) {
    constexpr Index guard = 16;  // loops read whole lanes
    each([&](Field& field) {
      if (wants(field, needs)) field.allocate(particles, guard);
    });
  }
  bool holds(Field const& field) const { return field.ref().data != nullptr; }
  ParticleFields refs() const;
};

}  // namespace piola::adaptle
