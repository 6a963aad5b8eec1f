// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/facet_fluxes.hpp"
#include "piola/formulations/nodal/set_up.hpp"
#include <vector>

namespace piola::nodal {

/// Records how exact the gradients of a body are. Throws InputError if the divergence theorem, or a gradient of a
/// quadratic field, is missed by more than rounding.
void check_gradients(SetUp const& from, GradientQuality const& found, std::vector<SetUpCheck>& checks);

/// Records how far corners of cells were moved onto the surface of the body. Nothing for bodies whose patches are not
/// known.
void check_surface(SetUp const& from, ScaledBody const& body, std::vector<SetUpCheck>& checks);

}  // namespace piola::nodal
