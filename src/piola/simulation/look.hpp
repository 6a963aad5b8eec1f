// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/output/picture.hpp"
#include <optional>
#include <string>

namespace piola {

/// How pictures look where it is not as the case has it: what is given here counts, see the keys of output.pictures.
struct LookOptions {
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
  bool ground = false, supports = false;  ///< false: as the case has it
};

/// A picture of a case with these options in place of its own. Throws InputError for a word that is not known.
PictureSpec with_look(PictureSpec picture, LookOptions const& look);

/// How the pictures of a case are framed. `up` is where its pictures have it, see upwards. Throws InputError if there
/// is no body of the name to be followed.
Camera camera_of(PictureSpec const& picture, Up up, std::span<BodySpec const> bodies, int dimension);
/// Size, colours and letters; the size follows the window where the case gives none.
PictureStyle style_of(PictureSpec const& picture, Camera const& camera, Window const& window);

}  // namespace piola
