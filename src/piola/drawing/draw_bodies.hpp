// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/colour_map.hpp"
#include "piola/drawing/picture.hpp"
#include "piola/drawing/projection.hpp"
#include "piola/input/picture_spec.hpp"
#include <optional>

namespace piola {

/// The size of a picture and where rigid shapes may be drawn in it [pixels].
struct SceneArea {
  int width = 0, height = 0;
  int top = 0, right = 0;  ///< margins for letters
  int bottom = 0;          ///< and below; 0: nothing does
};

/// Bodies, rigid shapes and reference outlines, lit, without letters. Without a background the image has opacity.
Image draw_bodies(PictureData const& data, Appearance const& appearance, Projection const& project,
                  SceneArea const& area, ColourMap const& map, std::optional<Colour> background);

}  // namespace piola
