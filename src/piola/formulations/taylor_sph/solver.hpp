// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/formulations/setting_warnings.hpp"
#include <memory>

namespace piola::taylor_sph {

/// Throws InputError for unsupported cases: mirror planes, laws without a rate form, thin bodies.
std::unique_ptr<Formulation> make(Assembly const& assembly);

/// Adds warnings about one body of a valid case.
void add_setting_warnings(Assembly const& assembly, std::size_t body, BodyWarnings& warnings);

}  // namespace piola::taylor_sph
