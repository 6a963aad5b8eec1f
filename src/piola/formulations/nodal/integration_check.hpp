// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/integration_constraint.hpp"
#include "piola/formulations/nodal/set_up.hpp"

namespace piola::nodal {

/// Adds iterations, residual and largest gradient to `checks`. Throws InputError if gradients violate the divergence
/// theorem, which creates spurious forces, or are so steep that steps become short.
void check_integration(SetUp const& from, IntegrationCorrection const& integration_correction,
                       std::vector<SetUpCheck>& checks);

}  // namespace piola::nodal
