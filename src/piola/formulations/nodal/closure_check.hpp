// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/closure.hpp"
#include "piola/formulations/set_up_checks.hpp"
#include "piola/particles/particle_set.hpp"
#include <vector>

namespace piola::nodal {

/// Adds the quality of a body's closure to `checks`. Throws InputError where its gradients miss the divergence theorem,
/// which gives forces out of nothing, or are steep, which gives short steps.
void check_closure(Body const& body, Closure const& closure, std::vector<SetUpCheck>& checks);

}  // namespace piola::nodal
