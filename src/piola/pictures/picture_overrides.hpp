// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/picture.hpp"
#include "piola/input/case_spec.hpp"
#include <functional>
#include <vector>

namespace piola {

/// Changes of the picture settings of a case, made in this order to the picture and to each panel.
using PictureOverrides = std::vector<std::function<void(PictureSpec&)>>;

/// Camera of the pictures of a case. `up`: upward axis, see upwards. Throws InputError if there is no such view or body
/// to follow.
Camera camera_of(PictureSpec const& picture, Up up, std::span<BodySpec const> bodies, int dimension);
/// Size, colours and fonts; the size follows from the window if the case gives none.
PictureStyle style_of(PictureSpec const& picture, Camera const& camera, Window const& window);

}  // namespace piola
