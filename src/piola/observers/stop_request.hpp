// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include <string>

namespace piola {

/// Reason of an observer to stop a run.
struct StopRequest {
  Failure failure;
  std::string causes;  ///< likely causes, for the user
};

}  // namespace piola
