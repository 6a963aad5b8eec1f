// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include <memory>
#include <string>

namespace piola {

/// A case ready to run.
struct Simulation {
  CaseSpec spec;
  ParticleSet particles;
  std::unique_ptr<Formulation> formulation;
  std::string formulation_name;  ///< of the bodies, joined with " + " if there are several
  double mass = 0;               ///< kg (per unit thickness or section in 2D and 1D)
  int threads = 1;
  std::vector<std::string> warnings;  ///< unusual settings of the case (guards/warnings.hpp)
};

/// Reports the formulations of a case that cannot run on several ranks.
void refuse_ranks(CaseSpec const& spec, Problems& problems);

/// Creates the particles of a case and evaluates the formulas of their initial state. Throws InputError with all errors
/// in regions and formulas.
Assembly assemble(CaseSpec const& spec);
/// As above, with the checked particles that `read_case` has created for this case.
Assembly assemble(CaseSpec const& spec, ParticleSet particles);

/// Builds the whole simulation and sets the number of threads. Throws InputError, also if the formulation rejects the
/// case or a probe asks for a field that it lacks.
Simulation build(CaseSpec spec);
/// As above, with the checked particles that `read_case` has created for this case.
Simulation build(CaseSpec spec, ParticleSet particles);

}  // namespace piola
