// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/input/case_spec.hpp"

namespace piola {

/// The shape with the same spacing, reduced to about `particles` particles along each direction.
ShapeSpec part_of(ShapeSpec const& shape, int particles);

/// Assembly with one body reduced to about `particles` per direction, for estimates. With kernel contact, data of the
/// formulation depend on its other bodies: a few particles of each are added outside the interaction range.
Assembly part_of_case(CaseSpec const& spec, std::size_t body, int particles);

}  // namespace piola
