// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/formulations/jst_sph/state.hpp"

namespace piola::jst_sph {

/// The one list of JST-SPH's particle fields, for a body of dimension D: memory and layout follow from it. Component
/// counts of tensors are D x D, of symmetric tensors D (D + 1) / 2.
struct Fields : FieldSet {
  explicit Fields(int D) : D_(D) {}
  int const D_;

  ListedField V{*this, "TributaryVolume", "m3", 1, Role::reference};
  ListedField C{*this, "GradientCorrection", "1", D_*(D_ + 1) / 2, Role::reference};
  ListedField G{*this, "GradientSum", "1/m", D_, Role::reference};
  ListedField alpha{*this, "LaplacianCorrectionLinear", "1/m3", D_, Role::reference};
  ListedField beta{*this, "LaplacianCorrectionQuadratic", "1/m4", 1, Role::reference};
  ListedField diagonal{*this, "LaplacianSum", "1/m2", 1, Role::reference};
  ListedField x{*this, "Position", "m", D_, Role::evolved};
  ListedField v{*this, "Velocity", "m/s", D_, Role::evolved};
  ListedField F{*this, "DeformationGradient", "1", D_* D_, Role::evolved};
  ListedField wave_speed{*this, "WaveSpeed", "m/s", 1, Role::evolved};
  ListedField filter_scale{*this, "FilterScale", "1", 1, Role::reference};
  ListedField filter_sum{*this, "FilterSum", "1", 1, Role::reference};
  ListedField volume_ratio{*this, "VolumeRatio", "1", 1, Role::derived};
  ListedField filtered_ratio{*this, "FilteredVolumeRatio", "1", 1, Role::derived};
  ListedField filtered_pressure{*this, "FilteredPressure", "Pa", 1, Role::derived};
  ListedField filter_source_a{*this, "FilterSourceA", "1", 1, Role::derived};
  ListedField filter_source_b{*this, "FilterSourceB", "1", 1, Role::derived};
  ListedField w{*this, "StabilisationArgument", "m/s", D_, Role::derived};
  ListedField A{*this, "WeightedStress", "Pa", D_* D_, Role::derived};
  ListedField stage_position{*this, "StagePosition", "m", D_, Role::derived};
  ListedField v_n{*this, "VelocityAtStepStart", "m/s", D_, Role::derived};
  ListedField F_star{*this, "DeformationGradientOfStage", "1", D_* D_, Role::derived};
  ListedField wave_speed_next{*this, "NextWaveSpeed", "m/s", 1, Role::derived};
  ListedField rate{*this, "Acceleration", "m/s2", D_, Role::derived};
  ListedField H{*this, "AreaMap", "1", 9, Role::evolved};
  ListedField J{*this, "EvolvedVolumeRatio", "1", 1, Role::evolved};
  ListedField H_star{*this, "AreaMapOfStage", "1", 9, Role::derived};
  ListedField J_n{*this, "VolumeRatioAtStepStart", "1", 1, Role::derived};
  ListedField J_next{*this, "NextVolumeRatio", "1", 1, Role::derived};
  ListedField J_rate{*this, "VolumeRatioStabilisation", "1/s", 1, Role::derived};
  ListedField w_J{*this, "VolumeStabilisationArgument", "1", 1, Role::derived};
};

}  // namespace piola::jst_sph
