// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/problems.hpp"
#include "piola/input/case_spec.hpp"

namespace piola {

/// Rigid shapes that are narrower than the spacing of a body that meets them: what is not resolved, and how it is felt.
void warn_of_narrow_shapes(CaseSpec const& spec, ParticleSet const& particles, Problems& found);

}  // namespace piola
