// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/setup/shapes.hpp"

namespace piola::app {

/// Prints for a solid: its exact volume, the quality of a packing, its thinnest place, and the patches for supports and
/// loads; for a packing and points from a file: where a gradient is most ill-conditioned. Prints nothing for other
/// shapes.
void print_solid_report(ShapeSpec const& shape, ParticleSet const& particles, Body const& body);

}  // namespace piola::app
