// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/doubts.hpp"
#include "piola/formulations/formulation.hpp"
#include <memory>

namespace piola::jst_sph {

/// Makes a JST-SPH run. Throws InputError (unknown machine, too few neighbours, options that cannot work).
std::unique_ptr<Formulation> make(Assembly const& assembly);

/// What is odd about one body of a case that this formulation can run.
void doubt(Assembly const& assembly, std::size_t body, BodyDoubts& doubts);

}  // namespace piola::jst_sph
