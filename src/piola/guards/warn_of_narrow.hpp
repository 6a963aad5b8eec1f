// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/errors.hpp"
#include "piola/input/case_spec.hpp"

namespace piola {

/// Warns of rigid shapes that are narrower than the spacing of a body in contact with them: unresolved features and
/// their effect.
void warn_of_narrow_shapes(CaseSpec const& spec, ParticleSet const& particles, Problems& found);

}  // namespace piola
