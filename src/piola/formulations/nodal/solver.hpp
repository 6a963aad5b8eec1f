// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/formulations/setting_warnings.hpp"
#include <memory>

namespace piola::nodal {

/// Creates a nodal run. Throws InputError (unknown instruction set, too few particles across, unusable laws).
std::unique_ptr<Formulation> make(Assembly const& assembly);

/// Adds warnings about one body of a valid case.
void add_setting_warnings(Assembly const& assembly, std::size_t body, BodyWarnings& warnings);

}  // namespace piola::nodal
