// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/estimates/estimate.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/particles/particle_set.hpp"

namespace piola::app {

/// Prints the prediction of a case for several ranks. Throws InputError if it cannot run on them.
void print_rank_estimate(CaseSpec const& spec, ParticleSet const& particles, Estimate const& cost, int ranks);

}  // namespace piola::app
