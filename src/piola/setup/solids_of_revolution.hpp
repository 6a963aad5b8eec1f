// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/setup/faces.hpp"
#include "piola/setup/shapes.hpp"
#include <vector>

/// Volumes and areas of axisymmetric bodies, whose shapes are half sections: x is the radius. All of the full circle.
/// Theory: docs/theory/axisymmetry.md, section 1.
namespace piola {

/// The length of a circle [m].
double circle(double radius);

/// Replaces areas of sections by volumes of rings [m^3]; those of solids sum to the exact volume.
void take_ring_volumes(ShapeSpec const& shape, ParticleSet& set, Body const& body);

/// Replaces lengths of faces of boxes and discs by areas of rings [m^2]. face: that they are parts of.
void take_ring_areas(ShapeSpec const& shape, ParticleSet const& set, Face const& face,
                     std::vector<FaceWeight>& weights);

/// The solid without what is beyond the axis.
void cut_at_axis(ShapeSpec& shape);

}  // namespace piola
