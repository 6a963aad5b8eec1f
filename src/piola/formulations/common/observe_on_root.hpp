// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include <memory>

namespace piola {

/// Wraps a formulation whose state is replicated on all ranks: only rank 0 evaluates diagnose(), sample() and save().
/// Returns the formulation itself on one rank.
std::unique_ptr<Formulation> observe_on_root(std::unique_ptr<Formulation> formulation);

}  // namespace piola
