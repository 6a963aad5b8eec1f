// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/registry.hpp"
#include "piola/formulations/taylor_sph/state.hpp"

namespace piola::taylor_sph {

/// User options with all defaults resolved.
struct Options {
  bool moving = true;  ///< updated Lagrangian; else in the initial configuration
  GradientForm form = GradientForm::linear_exact;
  Kernel const* kernel = nullptr;  ///< for estimates
  bool adjoint = true;             ///< the adjoint exchange between the two sets; else estimates by kernel sums
  double stress_retention = 0.2;   ///< adjoint: weight of the cells' own stress
  double hourglass_stiffness = 0;  ///< adjoint: of the patterns of boxes, as a fraction of D_11
  bool lattice_cells = false;      ///< virtual particles in the middle of lattice boxes; else of simplices
  bool stress_free = false;        ///< the missing directions: free of stress, else fixed
  double smoothing_length = 1;     ///< h in particle spacings
  double hourglass = 0;            ///< fraction of the hourglass pattern removed in each step
  bool conserve = true;            ///< conserve momenta of bodies without supports exactly
  double cfl = 1;                  ///< c dt / spacing
};

/// Registry entry: keys, meanings, defaults, laws.
FormulationInfo info();

/// Options of a body of that dimension. `cfl`: nan for the default; `whole_lattice`: every point of its lattice is a
/// particle. Throws InputError with all errors.
Options read_options(FormulationSpec const& spec, int dimension, double cfl, bool whole_lattice);

}  // namespace piola::taylor_sph
