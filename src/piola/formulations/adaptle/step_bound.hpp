// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/particles.hpp"
#include "piola/formulations/formulation.hpp"

namespace piola::adaptle {

/// As Formulation::step_bound(). Finds the particle that limits the stable step in a pass of its own over all
/// particles, so that the loops of a step need not track it.
StepBound find_step_bound(Particles const& particles);

}  // namespace piola::adaptle
