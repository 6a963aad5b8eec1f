// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/formulations/setting_warnings.hpp"
#include <memory>

namespace piola::jst_advection {

/// Throws InputError for anything but one row of particles without supports.
std::unique_ptr<Formulation> make(Assembly const& assembly);

/// Adds warnings about one body of a valid case.
void setting_warning(Assembly const& assembly, std::size_t body, BodyWarnings& setting_warnings);

}  // namespace piola::jst_advection
