// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/doubts.hpp"
#include "piola/formulations/formulation.hpp"
#include <memory>

namespace piola::taylor_sph {

/// Throws InputError for what it cannot build: mirror planes, laws without a rate form, thin bodies.
std::unique_ptr<Formulation> make(Assembly const& assembly);

/// What is odd about one body of a case that this formulation can run.
void doubt(Assembly const& assembly, std::size_t body, BodyDoubts& doubts);

}  // namespace piola::taylor_sph
