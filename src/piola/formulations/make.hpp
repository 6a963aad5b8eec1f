// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include <memory>

namespace piola {

/// Builds the formulation that the bodies ask for. Throws InputError if they ask for what cannot be built together, and
/// what the formulation itself refuses.
std::unique_ptr<Formulation> make_formulation(Assembly const& assembly);

}  // namespace piola
