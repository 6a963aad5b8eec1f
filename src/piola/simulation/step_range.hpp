// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include <string>

namespace piola {

/// How many times as many steps a run may take as its first steps say, and why.
struct StepExcess {
  double factor = 1;
  std::string why = {};  ///< empty: the number of steps is known
};

/// `change`: of the length of the last trial steps, as a fraction of it; 0 without a trial.
StepExcess step_excess(CaseSpec const& spec, double change);

}  // namespace piola
