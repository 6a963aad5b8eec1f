// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/surface.hpp"
#include "piola/setup/shapes.hpp"

namespace piola {

/// Contact points of a body's surface: one per particle and face of the exact shape, with the particle's part of the
/// area of the face. An edge particle of a box has a point on each of its faces. Does not set the modulus or add faces
/// of cracks.
contact::Surface contact_surface(ShapeSpec const& shape, ParticleSet const& particles, Body const& body);

}  // namespace piola
