// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include <string>

namespace piola {

/// Why an observer does not want a run to go on.
struct Objection {
  Failure failure;
  std::string causes;  ///< likely ones, for the user
};

}  // namespace piola
