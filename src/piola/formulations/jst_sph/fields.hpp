// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/common/field_list.hpp"

namespace piola::jst_sph {

/// Conditions under which a body has fields beyond positions, velocities and F.
struct FieldNeeds {
  bool displacement = false;     ///< F follows from positions
  bool verlet = false;           ///< velocity Verlet, else two stages of Runge-Kutta
  bool area = false;             ///< H is an unknown
  bool volume = false;           ///< J is an unknown
  bool smoothed_volume = false;  ///< and is stabilised
  bool filter = false;           ///< the volumetric energy is filtered
  bool mirrored = false;         ///< mirror planes
};

/// The one list of JST-SPH's particle fields, and what loops get of them. Memory and checkpoints follow from it; what
/// neighbours read is in NeighbourRecords. Numbers of components: D x D of tensors, D (D + 1) / 2 of symmetric ones.
struct Fields {
  /// of: owner of the memory; nullptr: none.
  explicit Fields(FieldList* of = nullptr, int D = 3, FieldNeeds const& needs = {})
      : owner(of), dimension(D), has(needs) {}
  FieldList* owner;
  int dimension;
  FieldNeeds has;

  // Reference: tributary volume, in the operators with mirror planes that of the continued body; weight of sums over
  // the body itself; corrections (pair_table_views.hpp).
  ListedRef V{owner, "TributaryVolume", "m3", 1, Role::reference};
  ListedRef weight{owner, "QuadratureWeight", "m3", 1, Role::reference, has.mirrored};  ///< without planes: V
  ListedRef C{owner, "GradientCorrection", "1", dimension*(dimension + 1) / 2, Role::reference};
  ListedRef G{owner, "GradientSum", "1/m", dimension, Role::reference};
  ListedRef alpha{owner, "LaplacianCorrectionLinear", "1/m3", dimension, Role::reference};
  ListedRef beta{owner, "LaplacianCorrectionQuadratic", "1/m4", 1, Role::reference};
  ListedRef diagonal{owner, "LaplacianSum", "1/m2", 1, Role::reference};

  // Evolved. `v` is p / rho0. Verlet's next step begins with the acceleration of the last one.
  ListedRef x{owner, "Position", "m", dimension, Role::evolved};
  ListedRef v{owner, "Velocity", "m/s", dimension, Role::evolved};
  ListedRef F{owner, "DeformationGradient", "1", dimension* dimension, Role::evolved};
  ListedRef wave_speed{owner, "WaveSpeed", "m/s", 1, Role::evolved};
  ListedRef H{owner, "AreaMap", "1", 9, Role::evolved, has.area};
  ListedRef J{owner, "VolumeRatio", "1", 1, Role::evolved, has.volume};
  ListedRef rate{owner, "Acceleration", "m/s2", dimension, has.verlet ? Role::evolved : Role::derived};

  // Filtered volumetric energy: volume ratio, its filtered form, pressure of the filtered part; Sinkhorn scaling d, sum
  // of the filter's weights without the diagonal; two buffers of d V f for neighbours.
  ListedRef filtered_ratio{owner, "FilteredRatio", "1", 1, Role::evolved, has.filter};
  ListedRef filtered_pressure{owner, "FilteredPressure", "Pa", 1, Role::evolved, has.filter};
  ListedRef volume_ratio{owner, "VolumeRatioOfF", "1", 1, Role::derived, has.verlet};
  ListedRef filter_scale{owner, "FilterScale", "1", 1, Role::reference, has.filter};
  ListedRef filter_sum{owner, "FilterSum", "1", 1, Role::reference, has.filter};
  ListedRef filter_source[2]{{owner, "FilterSourceA", "1", 1, Role::derived, has.filter},
                             {owner, "FilterSourceB", "1", 1, Role::derived, has.filter}};

  // Neighbour data of the second sweep: argument of the second Laplacian; (V / V_kernel) P C.
  ListedRef w{owner, "StabilisationArgument", "m/s", dimension, Role::derived};
  ListedRef A{owner, "WeightedStress", "Pa", dimension* dimension, Role::derived};
  ListedRef w_J{owner, "VolumeStabilisationArgument", "1", 1, Role::derived, has.smoothed_volume};

  // Within a step.
  ListedRef stage_position{owner, "StagePosition", "m", dimension, Role::derived, has.displacement};
  ListedRef v_n{owner, "VelocityAtStepStart", "m/s", dimension, Role::derived, !has.verlet};
  ListedRef F_star{owner, "DeformationGradientOfStage", "1", dimension* dimension, Role::derived, !has.verlet};
  ListedRef wave_speed_next{owner, "NextWaveSpeed", "m/s", 1, Role::derived, !has.verlet};
  ListedRef H_star{owner, "AreaMapOfStage", "1", 9, Role::derived, has.area};
  ListedRef J_n{owner, "VolumeRatioAtStepStart", "1", 1, Role::derived, has.volume};
  ListedRef J_next{owner, "NextVolumeRatio", "1", 1, Role::derived, has.smoothed_volume};
  ListedRef J_rate{owner, "VolumeRatioStabilisation", "1/s", 1, Role::derived, has.smoothed_volume};
};

}  // namespace piola::jst_sph
