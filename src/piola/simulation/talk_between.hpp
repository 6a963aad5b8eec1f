// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/simulation/estimate.hpp"

namespace piola {

/// Puts into `cost`, which is of bodies looked at one by one (estimate_from_parts), what ranks tell each other because
/// of where bodies are and what the others of the case do: counted on all of the particles, at the start, without
/// building what moves them. Throws InputError for what a formulation refuses.
void count_talk_between(Assembly const& assembly, Estimate& cost);

}  // namespace piola
