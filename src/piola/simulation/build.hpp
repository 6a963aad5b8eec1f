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
  std::string formulation_name;  ///< of the bodies, joined with " + " if there are several
  double mass = 0;               ///< kg (per unit thickness or section in 2D and 1D)
  int threads = 1;
  std::vector<std::string> warnings;  ///< what looks odd about the case (simulation/warnings.hpp)
};

/// What the formulation is built from: the particles of a case, and its formulas evaluated there. Throws InputError
/// with all that is wrong with regions and formulas.
Assembly assemble(CaseSpec const& spec);
/// The same with the particles that `read_case` has made of this very case, and checked.
Assembly assemble(CaseSpec const& spec, ParticleSet particles);

/// Builds the whole simulation and sets the number of threads. Throws InputError, also for what the formulation
/// refuses and for probes of fields that it does not have.
Simulation build(CaseSpec spec);
/// The same with the particles that `read_case` has made of this very case, and checked: they are made once.
Simulation build(CaseSpec spec, ParticleSet particles);

}  // namespace piola
