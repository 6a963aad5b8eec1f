// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/estimates/case_plan.hpp"

namespace piola::app {

/// Prints steps, times, memory and disk of a run, for `piola check`.
void say_cost(CasePlan const& plan);

/// Prints the particles and the memory of one of `ranks` ranks.
void say_ranks(CasePlan const& plan, int ranks);

}  // namespace piola::app
