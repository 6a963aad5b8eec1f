// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/setup/shapes.hpp"

namespace piola {

/// Scatters the particles of a box that are not on its faces: random places, then eight of Lloyd's steps (IEEE Trans.
/// Inf. Theory 28, 1982), each to the centroids of the cells. Tributary volumes become those of the cells. The same
/// seed gives the same particles on every machine. `body` is the body of these particles in `set`.
void scatter(ShapeSpec const& shape, ParticleSet& set, Body const& body);

}  // namespace piola
