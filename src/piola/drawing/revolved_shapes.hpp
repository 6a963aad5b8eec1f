// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/rigid_picture.hpp"
#include "piola/drawing/skin.hpp"
#include <optional>
#include <span>
#include <vector>

/// Rigid shapes in pictures of axisymmetric bodies, see revolution.hpp.
namespace piola {

/// The box around both sides of a section (angle 0), or around its full circle.
Stage revolved(Stage const& section, double degrees);

/// Shapes in the section, those beside the axis also on its other side.
std::vector<RigidShape> with_mirror_images(std::span<RigidShape const> shapes);

/// The surface of the body that a shape of the section is swept to, an angle above 0. A plane is a round plate behind
/// its face, of the size of the stage.
Skin revolved(RigidShape const& shape, Stage const& stage, double degrees);

/// Lets the window show the shapes as show_shapes does; `swept`: see PictureData.
void show_all_shapes(Window& window, View const& view, std::span<RigidShape const> shapes, Stage const& stage,
                     std::optional<double> const& swept);

}  // namespace piola
