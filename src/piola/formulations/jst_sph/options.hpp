// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/jst_sph/state.hpp"
#include "piola/formulations/registry.hpp"
#include "piola/kernels/registry.hpp"

namespace piola::jst_sph {

/// User options with all defaults resolved.
struct Options {
  Variables variables = Variables::pF;
  GradientForm gradient = GradientForm::corrected, force = GradientForm::corrected;
  Biharmonic biharmonic = Biharmonic::adjoint;
  Kernel const* kernel = nullptr;
  double eps2 = 0, eps4 = 0;      ///< harmonic and biharmonic coefficients for p
  double eps2_J = 0, eps4_J = 0;  ///< harmonic and biharmonic coefficients for J
  double gradient_support = 0;    ///< h of the gradient in particle spacings
  double laplacian_support = 0;   ///< h of the Laplacian in particle spacings
  Integrator integrator = Integrator::verlet;
  bool shear_speed = true;  ///< stabilise with the shear-type wave speed instead of c_p
  bool filter = true;       ///< filter the volumetric energy of nearly incompressible materials
  int filter_passes = 2;
  double local_bulk = 1;                                     ///< bulk modulus on the local volume ratio over mu
  double hourglass_stiffness = 0, hourglass_stiffening = 0;  ///< xi_0, xi_1
  double hourglass_viscosity = 0, bulk_viscosity = 0;        ///< theta, beta
  bool project = true;                                       ///< angular and linear momentum projection
  bool exact_speed = false;                                  ///< p-wave speed from the law's tangent
  bool multipliers = false;                                  ///< exact boundary values (Appendix B)
  double cfl = 0;  ///< alpha of eq. (44); 0: from the stability limit of the scheme

  bool hourglass() const { return hourglass_stiffness > 0 || hourglass_stiffening > 0; }
  bool without_rigid() const { return shear_speed && biharmonic != Biharmonic::none; }
  bool corrected_kernel() const {
    return gradient == GradientForm::corrected_kernel || force == GradientForm::corrected_kernel;
  }
  bool smoothed_volume() const { return eps2_J > 0 || eps4_J > 0; }
};

/// Registry entry: keys, meanings, defaults, laws.
FormulationInfo info();

/// Options of a body, whose particles are on a lattice (`regular`) or not. Throws InputError for invalid combinations.
Options read_options(FormulationSpec const& spec, MaterialParameters const& material, double cfl, bool regular = true);

}  // namespace piola::jst_sph
