// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include "piola/mechanics/rigid_shape.hpp"
#include <vector>

namespace piola::contact {

/// A point of the surface of a rigid shape at the start.
struct SurfaceSample {
  Vec<3> arm;       ///< from the centre [m]
  double area = 0;  ///< area it represents [m2]; in 2D a length
};

/// Points on the surface of a box or a cylinder, including its edges and corners. Their areas sum to that of the shape.
/// Twelve intervals along the longest side; 32 around. Test: RigidSamples.
std::vector<SurfaceSample> samples_of(RigidShape const& shape, int dimension);

}  // namespace piola::contact
