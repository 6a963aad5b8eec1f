// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/jst_sph/state.hpp"
#include "piola/formulations/registry.hpp"
#include "piola/kernels/registry.hpp"

namespace piola::jst_sph {

/// User options with all defaults resolved.
struct Options {
  Variables variables = Variables::pF;
  Biharmonic biharmonic = Biharmonic::adjoint;
  Kernel const* kernel = nullptr;
  double eps2 = 0, eps4 = 0;      ///< harmonic and biharmonic coefficients for p
  double eps2_J = 0, eps4_J = 0;  ///< harmonic and biharmonic coefficients for J
  double gradient_support = 0;    ///< h of the gradient in particle spacings
  double laplacian_support = 0;   ///< h of the Laplacian in particle spacings
  Integrator integrator = Integrator::verlet;
  bool filter = false;       ///< filter the volumetric energy: scheme "filtered", nearly incompressible materials
  bool project = true;       ///< angular and linear momentum projection
  bool exact_speed = false;  ///< p-wave speed from the law's tangent
  bool multipliers = false;  ///< exact boundary values (Appendix B)
  double cfl = 0;            ///< alpha of eq. (44); 0: from the stability limit of the scheme

  bool smoothed_volume() const { return eps2_J > 0 || eps4_J > 0; }
};

/// Registry entry: keys, meanings, defaults, laws.
FormulationInfo info();

/// Options of a body. Throws InputError for invalid combinations.
Options read_options(FormulationSpec const& spec, MaterialParameters const& material, double cfl);

}  // namespace piola::jst_sph
