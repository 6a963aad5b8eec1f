// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/depth_image.hpp"
#include <span>

namespace piola {

/// The box around the bodies at the start [m]: where a plane, which has no end, is shown.
struct Stage {
  std::array<double, 3> low{}, high{};
  static Stage around(std::span<std::array<double, 3> const> points);
  std::array<double, 3> middle() const;
  double size() const;  ///< length of the diagonal [m]
};

/// Draws rigid shapes in grey. A plane is a thin plate behind its face, of the size of the stage, opposite its middle.
/// In two dimensions the shapes lie behind all particles. Nothing is drawn in columns from `width` on and in rows above
/// `top`, where the letters stand. `fine`: pixels of the image per pixel of the projection.
struct RigidCanvas {
  Projection const& project;
  Stage const& stage;
  int dimension = 3, fine = 1, top = 0, width = 0;
  void draw(DepthImage& image, std::span<RigidShape const> shapes) const;
};

/// Lets the window show the shapes that have an end, unless they are more than twice as large as the stage.
void show_shapes(Window& window, View const& view, std::span<RigidShape const> shapes, Stage const& stage);

}  // namespace piola
