// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/setup/shapes.hpp"

namespace piola::app {

/// Says of a solid: its exact volume, how good a packing is, where it is thinnest, and the patches that supports and
/// loads can name; of a packing and of points from a file: where a gradient is hardest to form. Of others nothing.
void say_solid(ShapeSpec const& shape, ParticleSet const& particles, Body const& body);

}  // namespace piola::app
