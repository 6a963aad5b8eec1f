// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/picture.hpp"
#include "piola/input/case_spec.hpp"
#include <optional>
#include <string>

namespace piola {

/// Overrides of the picture settings of a case, see the keys of output.pictures.
struct PictureOverrides {
  std::optional<std::array<double, 2>> view = {};  ///< azimuth and elevation [deg]
  std::string named_view = {};                     ///< one of view_words
  std::string up = "auto";
  std::optional<double> roll = {};                    ///< deg
  std::optional<double> zoom = {}, perspective = {};  ///< perspective: deg
  std::optional<std::array<double, 3>> look_at = {};  ///< m
  std::string follow = {};                            ///< name of a body
  std::optional<std::array<int, 2>> size = {};        ///< pixels
  std::string theme = {}, map = {};
  std::optional<bool> labels = {};
  std::string quality = {};
  std::optional<double> warp = {};
  bool ground = false, supports = false;  ///< false: as in the case
};

/// The picture of a case with these overrides. Throws InputError for an unknown word.
PictureSpec with_overrides(PictureSpec picture, PictureOverrides const& look);

/// Camera of the pictures of a case. `up`: upward axis, see upwards. Throws InputError if the body to follow does not
/// exist.
Camera camera_of(PictureSpec const& picture, Up up, std::span<BodySpec const> bodies, int dimension);
/// Size, colours and fonts; the size follows from the window if the case gives none.
PictureStyle style_of(PictureSpec const& picture, Camera const& camera, Window const& window);

}  // namespace piola
