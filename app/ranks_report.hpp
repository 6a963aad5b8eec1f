// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/particles/particle_set.hpp"
#include "piola/simulation/estimate.hpp"

namespace piola::app {

/// Prints the prediction of a case for several ranks. Throws InputError if it cannot run on them.
void say_ranks(CaseSpec const& spec, ParticleSet const& particles, Estimate const& cost, int ranks);

}  // namespace piola::app
