// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"

namespace piola::jst_sph {

/// The one list of JST-SPH's particle fields, for a body of dimension D: memory, layout, checkpoint and the table of
/// the manual follow from it. Component counts of tensors are D x D, of symmetric tensors D (D + 1) / 2.
struct Fields {
  explicit Fields(int D)
      : V("TributaryVolume", "m3", 1, Role::reference),
        C("GradientCorrection", "1", D * (D + 1) / 2, Role::reference),
        G("GradientSum", "1/m", D, Role::reference),
        alpha("LaplacianCorrectionLinear", "1/m3", D, Role::reference),
        beta("LaplacianCorrectionQuadratic", "1/m4", 1, Role::reference),
        diagonal("LaplacianSum", "1/m2", 1, Role::reference),
        x("Position", "m", D, Role::evolved),
        v("Velocity", "m/s", D, Role::evolved),
        F("DeformationGradient", "1", D * D, Role::evolved),
        wave_speed("WaveSpeed", "m/s", 1, Role::evolved),
        filter_scale("FilterScale", "1", 1, Role::reference),
        filter_sum("FilterSum", "1", 1, Role::reference),
        volume_ratio("VolumeRatio", "1", 1, Role::derived),
        filtered_ratio("FilteredVolumeRatio", "1", 1, Role::derived),
        filtered_pressure("FilteredPressure", "Pa", 1, Role::derived),
        filter_source_a("FilterSourceA", "1", 1, Role::derived),
        filter_source_b("FilterSourceB", "1", 1, Role::derived),
        w("StabilisationArgument", "m/s", D, Role::derived),
        A("WeightedStress", "Pa", D * D, Role::derived),
        stage_position("StagePosition", "m", D, Role::derived),
        v_n("VelocityAtStepStart", "m/s", D, Role::derived),
        F_star("DeformationGradientOfStage", "1", D * D, Role::derived),
        wave_speed_next("NextWaveSpeed", "m/s", 1, Role::derived),
        rate("Acceleration", "m/s2", D, Role::derived),
        H("AreaMap", "1", 9, Role::evolved),
        J("EvolvedVolumeRatio", "1", 1, Role::evolved),
        H_star("AreaMapOfStage", "1", 9, Role::derived),
        J_n("VolumeRatioAtStepStart", "1", 1, Role::derived),
        J_next("NextVolumeRatio", "1", 1, Role::derived),
        J_rate("VolumeRatioStabilisation", "1/s", 1, Role::derived),
        w_J("VolumeStabilisationArgument", "1", 1, Role::derived),
        ratio_increment("VolumeRatioIncrement", "1", 1, Role::derived),
        filter_input("VolumeRatioAhead", "1", 1, Role::evolved),
        ratio_change("VolumeRatioChange", "1", 1, Role::derived),
        hourglass_force("HourglassAcceleration", "m/s2", D, Role::evolved),
        hourglass_stress("HourglassStress", "Pa", D * D, Role::evolved),
        viscous_work("ViscousWork", "J/m3", 1, Role::derived),
        hourglass_energy("HourglassEnergy", "J/m3", 1, Role::derived),
        seen_ratio("SeenVolumeRatio", "1", 1, Role::derived),
        last_F("DeformationGradientOfLastStep", "1", 9, Role::evolved),
        history("SolidHistory", "1", 12, Role::evolved),
        full_correction("FullGradientCorrection", "1", D * D, Role::reference),
        gamma("KernelGradientMean", "1/m", D, Role::reference),
        kernel_difference("KernelDifference", "m/s", D, Role::derived),
        kernel_force("KernelForce", "Pa/m", D, Role::derived),
        kernel_force_sum("KernelForceSum", "Pa/m", D, Role::derived) {}

  Field V, C, G, alpha, beta, diagonal;
  Field x, v, F, wave_speed;
  Field filter_scale, filter_sum, volume_ratio, filtered_ratio, filtered_pressure, filter_source_a, filter_source_b;
  Field w, A, stage_position, v_n, F_star, wave_speed_next, rate;
  Field H, J, H_star, J_n, J_next, J_rate, w_J, ratio_increment;
  Field filter_input, ratio_change, hourglass_force, hourglass_stress, viscous_work, hourglass_energy, seen_ratio;
  Field last_F, history;
  Field full_correction, gamma, kernel_difference, kernel_force, kernel_force_sum;

  template <class Visit>
  void each(Visit&& visit) {
    for (Field* f : {&V,
                     &C,
                     &G,
                     &alpha,
                     &beta,
                     &diagonal,
                     &x,
                     &v,
                     &F,
                     &wave_speed,
                     &filter_scale,
                     &filter_sum,
                     &volume_ratio,
                     &filtered_ratio,
                     &filtered_pressure,
                     &filter_source_a,
                     &filter_source_b,
                     &w,
                     &A,
                     &stage_position,
                     &v_n,
                     &F_star,
                     &wave_speed_next,
                     &rate,
                     &H,
                     &J,
                     &H_star,
                     &J_n,
                     &J_next,
                     &J_rate,
                     &w_J,
                     &ratio_increment,
                     &filter_input,
                     &hourglass_force,
                     &hourglass_stress,
                     &viscous_work,
                     &ratio_change,
                     &hourglass_energy,
                     &seen_ratio,
                     &last_F,
                     &history,
                     &full_correction,
                     &gamma,
                     &kernel_difference,
                     &kernel_force,
                     &kernel_force_sum})
      visit(*f);
  }
};

}  // namespace piola::jst_sph
