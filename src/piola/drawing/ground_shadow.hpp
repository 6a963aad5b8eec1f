// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/draw_bodies.hpp"
#include "piola/drawing/shade.hpp"
#include <vector>

namespace piola {

/// Light of the ground below the bodies per pixel; empty if there is none. The ground lies at the lowest place of the
/// reference configuration and fades out around the bodies. Their shadow is the fraction of the sky that the lowest
/// surfaces above it hide, sum of A h^2 / (pi (d^2 + h^2)^2) over patches of area A at the height h and the distance d
/// (the form factor of two small parallel patches), so that it is dark where a body touches and soft where it is far.
std::vector<GroundLight> ground_below(PictureData const& data, Appearance const& appearance, Projection const& project,
                                      SceneArea const& area);

}  // namespace piola
