// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/doubts.hpp"

namespace piola::nodal {

/// What is odd about one body of a case that this formulation can run.
void doubt(Assembly const& assembly, std::size_t body, BodyDoubts& doubts);

}  // namespace piola::nodal
