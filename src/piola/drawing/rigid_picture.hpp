// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/picture.hpp"
#include "piola/drawing/raster.hpp"
#include <span>

namespace piola {

struct Projection;

/// The box around the bodies at the start [m]: where a plane, which has no end, is shown.
struct Stage {
  std::array<double, 3> low{}, high{};
  static Stage around(std::span<std::array<double, 3> const> points);
  std::array<double, 3> middle() const;
  double size() const;  ///< length of the diagonal [m]
};

/// Draws rigid shapes. A plane is a thin plate behind its face, of the size of the stage, opposite its middle. In two
/// dimensions the shapes lie behind all particles. Nothing is drawn in columns from `width` on and in rows above `top`,
/// which are reserved for letters. `fine`: samples per pixel of the projection.
struct RigidCanvas {
  static constexpr Owner bright = 0, dark = 1;  ///< every other part of balls that turn is dark
  static constexpr std::array<Colour, 2> colours{Colour{176, 180, 186}, Colour{138, 143, 151}};
  Projection const& project;
  Stage const& stage;
  int dimension = 3, fine = 1, top = 0, width = 0;
  void draw(SurfaceBuffers& buffers, std::span<RigidShape const> shapes) const;
};

/// Lets the window show the shapes that have an end, unless they are more than twice as large as the stage.
void show_shapes(Window& window, View const& view, std::span<RigidShape const> shapes, Stage const& stage);

}  // namespace piola
