// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include <memory>

namespace piola {

/// Builds the formulation of the bodies, or their combination. Throws InputError if they cannot be combined or a
/// formulation rejects its input. Defined in registry.cpp, beside the list of formulations.
std::unique_ptr<Formulation> make_formulation(Assembly const& assembly);

}  // namespace piola
