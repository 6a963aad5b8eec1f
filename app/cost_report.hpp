// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/estimates/case_plan.hpp"

namespace piola::app {

/// Prints steps, times, memory and disk of a run, for `piola check`.
void say_cost(CasePlan const& plan);

}  // namespace piola::app
