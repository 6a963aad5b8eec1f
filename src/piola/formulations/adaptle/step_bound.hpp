// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/particles.hpp"
#include "piola/formulations/observables.hpp"

namespace piola::adaptle {

/// Implements Observables::step_bound(). A separate pass over all particles finds the particle that limits the stable
/// step, so that the loops of a step need not track this particle.
StepBound find_step_bound(Particles const& particles);

}  // namespace piola::adaptle
