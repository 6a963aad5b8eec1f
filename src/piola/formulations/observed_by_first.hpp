// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include <memory>

namespace piola {

/// Of several ranks rank 0 observes the formulation alone: what Formulation asks of diagnose(), sample() and save() on
/// ranks, for formulations of which every rank has all. On one rank the formulation itself.
std::unique_ptr<Formulation> observed_by_first(std::unique_ptr<Formulation> formulation);

}  // namespace piola
