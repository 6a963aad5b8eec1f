// SPDX-License-Identifier: Apache-2.0
#include "piola/pictures/picture_overrides.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/formulations/field_signs.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace piola {

Camera camera_of(PictureSpec const& picture, Up up, std::span<BodySpec const> bodies, int dimension) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  PIOLA_EXPECTS(picture.zoom > 0);
  Camera camera{
      .view = {picture.view[0], picture.view[1], up, picture.roll}, .zoom = picture.zoom, .look_at = picture.look_at};
  if (!picture.named_view.empty()) {
    auto const named = named_view(picture.named_view, up);
    if (!named)
      throw InputError(fmt::format("view: '{}' is not known (allowed: {}) - choose one of these", picture.named_view,
                                   fmt::join(view_words, ", ")));
    camera.view.azimuth = (*named)[0];
    camera.view.elevation = (*named)[1];
  }
  camera.view = camera.view.in(dimension);
  if (picture.followed_body.empty()) return camera;
  auto const body = std::find_if(bodies.begin(), bodies.end(),
                                 [&](BodySpec const& one) { return one.name == picture.followed_body; });
  if (body == bodies.end()) {
    std::vector<std::string> names;
    for (BodySpec const& one : bodies) names.push_back(one.name);
    throw InputError(fmt::format("follow: there is no body '{}' (allowed: {}) - choose one of these",
                                 picture.followed_body, fmt::join(names, ", ")));
  }
  camera.followed_body = static_cast<int>(body - bodies.begin());
  return camera;
}

PictureStyle style_of(PictureSpec const& picture, Camera const& camera, Window const& window) {
  std::array<int, 2> size{picture.width, picture.height};
  if (size[0] <= 0 || size[1] <= 0) {
    size = fitting_size(window);
    for (int& side : size) side = 2 * std::max(1, static_cast<int>(std::lround(picture.scale * side / 2)));
  }
  return {.width = size[0],
          .height = size[1],
          .view = camera.view,
          .range = picture.range ? picture.range : whole_range(picture.field),
          .theme = picture.theme,
          .labels = picture.labels,
          .palette = palette_for(picture.field, picture.map)};
}

}  // namespace piola
