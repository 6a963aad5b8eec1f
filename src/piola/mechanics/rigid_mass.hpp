// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include "piola/mechanics/rigid_shape.hpp"

namespace piola {

/// Volume of a rigid shape [m3]; in 2D its area [m2]; infinite for a plane.
double volume_of(RigidShape const& shape, int dimension);
/// Volume of the body of revolution whose section in 2D the shape is: of a sphere or box about the axis x = 0, or
/// beside it [m3].
double swept_volume_of(RigidShape const& shape);

/// Principal inertia of a shape about its centre: as given, else that of the homogeneous shape.
struct PrincipalInertia {
  Vec<3> moment;  ///< about the axes below [kg m2]; in 2D only the last, per length [kg m]
  Mat<3> axes;    ///< columns: unit vectors
};
PrincipalInertia inertia_of(RigidShape const& shape, int dimension);

}  // namespace piola
