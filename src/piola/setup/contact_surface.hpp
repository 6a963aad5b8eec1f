// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/surface.hpp"
#include "piola/setup/shapes.hpp"

namespace piola {

/// The points of a body's surface that contact sees: one per particle and face of the exact shape, with the share of
/// the face that the particle stands for. An edge particle of a box has a point on each of its faces. Modulus and faces
/// of cracks are left to others.
contact::Surface contact_surface(ShapeSpec const& shape, ParticleSet const& particles, Body const& body);

}  // namespace piola
