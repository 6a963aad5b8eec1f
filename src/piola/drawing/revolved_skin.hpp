// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/skin.hpp"

/// Skins of axisymmetric bodies, see revolution.hpp.
namespace piola {

/// Computes the skin of a section on both sides of the axis (angle 0), or the surface of the swept body. A sweep of
/// less than a full circle has the section at both ends. Normals are smooth but for edges of more than 55 degrees.
/// Corners nearer to the axis than `axis_width` [m] in the reference configuration are put on it, see width_of_axis.
/// `whole` and `inside` are those of the section.
Skin revolved(Skin const& section, double degrees, double axis_width);

}  // namespace piola
