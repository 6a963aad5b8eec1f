// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/estimates/estimate.hpp"
#include "piola/formulations/assembly.hpp"

namespace piola {

/// Adds to `cost`, an estimate by separate bodies (estimate_from_parts), the communication between bodies: spatial halo
/// and common step, counted on all particles at the start, without building the formulations. Throws InputError if a
/// formulation rejects the case.
void count_talk_between(Assembly const& assembly, Estimate& cost);

}  // namespace piola
