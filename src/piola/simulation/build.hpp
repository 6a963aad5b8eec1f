// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include <memory>
#include <string>

namespace piola {

/// A case made ready to run.
struct Simulation {
  CaseSpec spec;
  ParticleSet particles;
  std::unique_ptr<Formulation> formulation;
  std::string formulation_name;  ///< names of all bodies' formulations, joined with " + " if there are several
  double mass = 0;               ///< kg (per unit thickness or section in 2D and 1D)
  int threads = 1;
};

/// Particles, initial values and supports of a case. Throws InputError with every initial value that is not finite and every
/// support that selects nothing.
Assembly assemble(CaseSpec const& spec);

/// Builds the whole simulation and sets the number of threads. Throws InputError.
Simulation build(CaseSpec spec);

}  // namespace piola
