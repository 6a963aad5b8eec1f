// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include <string>

namespace piola {

/// Factor by which the number of steps may exceed the estimate from the first steps, and the reason.
struct StepExcess {
  double factor = 1;
  std::string why = {};  ///< empty: the number of steps is exact
};

/// `change`: relative change of the length of the last trial steps; 0 without a trial.
StepExcess step_excess(CaseSpec const& spec, double change);

}  // namespace piola
