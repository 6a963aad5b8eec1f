// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include <memory>

namespace piola::jst_sph {

/// Makes a JST-SPH run. Throws InputError (unknown machine, too few neighbours, options that cannot work).
std::unique_ptr<Formulation> make(Assembly const& assembly);

}  // namespace piola::jst_sph
