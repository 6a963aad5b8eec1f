// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"

namespace piola::adaptle {

/// Sums over reference neighbours, with s = -W'(r)/r.
enum class MaterialForm {
  corrected,       ///< G_ab = K_a s r, viscosity along the line of centres
  plain,           ///< the same with K_a = 1
  published,       ///< set (2) of the paper with the correction (4), (5): G_ab = K_a (s r S - G W) / S^2
  published_plain  ///< set (2) with G_ab = s r
};

/// Forces between total-Lagrangian and Eulerian particles.
enum class Interface {
  owner,        ///< each particle acts through its own gradients, its neighbours receive the reaction: conserves
  as_published  ///< each particle sums with its own kernel type over all its neighbours, as published
};

/// The equations of a run, as published or the default ones. Whatever differs between them is asked here alone; loops
/// over pairs know the form at compile time.
struct EquationSet {
  MaterialForm form = MaterialForm::plain;
  Interface interface_form = Interface::owner;

  // Sums over reference neighbours
  /// Gradients of linear fields are exact.
  PIOLA_FN constexpr bool has_correction() const {
    return form == MaterialForm::corrected || form == MaterialForm::published;
  }
  /// Gradients have a part with W.
  PIOLA_FN constexpr bool has_kernel_part() const { return form == MaterialForm::published; }
  /// Pairs and particles carry W, and the correction is N and the mean gradient instead of a symmetric K.
  PIOLA_FN constexpr bool stores_kernel() const { return is_set_2(); }
  /// s is stored as float, which the correction compensates.
  PIOLA_FN constexpr bool rounds_gradients() const { return form == MaterialForm::corrected; }
  /// Viscosity acts along the line of centres, in the first sweep; else by the deformed gradients, in the second.
  PIOLA_FN constexpr bool has_central_viscosity() const { return !is_set_2(); }
  /// Neighbours read the deformation for the viscosity: a, F^-T N, F^-T n and 1/J.
  PIOLA_FN constexpr bool records_deformation() const { return is_set_2(); }
  /// There are springs against displacements that deformation gradients do not explain.
  PIOLA_FN constexpr bool has_hourglass_stiffness() const { return !is_set_2(); }

  // Particles of both descriptions
  /// Kernel types change gradually at the border of a patch; else the interface is sharp.
  PIOLA_FN constexpr bool blends() const { return !is_sharp(); }
  /// Neighbours of the other description receive the reaction of a particle's own stress force.
  PIOLA_FN constexpr bool has_reactions() const { return !is_sharp(); }
  /// Stress counts by the kernel type, phi in space and 1 - phi in the reference configuration; else in full in both.
  PIOLA_FN constexpr bool splits_stress() const { return !is_sharp(); }
  /// Eulerian particles with total-Lagrangian reference neighbours have a deformation gradient.
  PIOLA_FN constexpr bool deforms_eulerian() const { return is_sharp(); }
  /// Total-Lagrangian particles have the viscosity with Eulerian ones from material sums; else both have it from
  /// spatial sums.
  PIOLA_FN constexpr bool has_mixed_viscosity() const { return is_sharp(); }

 private:
  PIOLA_FN constexpr bool is_set_2() const {
    return form == MaterialForm::published || form == MaterialForm::published_plain;
  }
  PIOLA_FN constexpr bool is_sharp() const { return interface_form == Interface::as_published; }
};

}  // namespace piola::adaptle
