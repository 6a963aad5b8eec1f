// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/input/case_spec.hpp"

namespace piola {

/// The same shape with the same spacing, cut down to about this many particles along each direction.
ShapeSpec part_of(ShapeSpec const& shape, int particles);

/// A body cut down so, to be built in place of all of it. Where what a formulation has of a body depends on the others,
/// as on whether one of them flows, a few particles of each of these stand beside it, out of reach.
Assembly part_of_case(CaseSpec const& spec, std::size_t body, int particles);

}  // namespace piola
