// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/body.hpp"
#include <vector>

namespace piola::nodal {

/// Local cells of a body that fail at the end of a step, and particles that come off: those of the neighbours of local
/// cells, too. near_crack: per slot, not 0 for local cells beside failed ones. Theory: docs/theory/nodal.md, "Failure".
std::vector<Refits::Change> find_failing(NodalBody const& body, std::vector<char> const& near_crack);

}  // namespace piola::nodal
