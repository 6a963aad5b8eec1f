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
namespace {

/// The number of a word in its list.
template <std::size_t N>
std::size_t number_of(std::string_view word, std::array<std::string_view, N> const& words, char const* what) {
  auto const found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  throw InputError(
      fmt::format("{}: '{}' is not known (allowed: {}) - choose one of these", what, word, fmt::join(words, ", ")));
}

}  // namespace

PictureSpec with_overrides(PictureSpec picture, PictureOverrides const& look) {
  auto const take = [](auto& target, auto const& given) {
    if (given) target = *given;
  };
  auto const take_word = [](std::string& target, std::string const& given) {
    if (!given.empty()) target = given;
  };
  if (look.view) picture.named_view.clear();
  take(picture.view, look.view);
  if (!look.named_view.empty()) number_of(look.named_view, view_words, "view");
  take_word(picture.named_view, look.named_view);
  if (look.up != "auto") picture.up = look.up;
  take(picture.roll, look.roll);
  take(picture.zoom, look.zoom);
  take(picture.perspective, look.perspective);
  take(picture.labels, look.labels);
  take(picture.warp, look.warp);
  take_word(picture.quality, look.quality);
  number_of(picture.quality, quality_words, "quality");
  picture.ground = picture.ground || look.ground;
  picture.supports = picture.supports || look.supports;
  if (look.look_at) picture.look_at = look.look_at;
  take_word(picture.follow, look.follow);
  take_word(picture.theme, look.theme);
  take_word(picture.map, look.map);
  number_of(picture.theme, theme_words, "theme");
  number_of(picture.map, palette_words, "map");
  if (look.size) {
    picture.width = (*look.size)[0];
    picture.height = (*look.size)[1];
  }
  return picture;
}

Camera camera_of(PictureSpec const& picture, Up up, std::span<BodySpec const> bodies, int dimension) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  PIOLA_EXPECTS(picture.zoom > 0);
  Camera camera{
      .view = {picture.view[0], picture.view[1], up, picture.roll}, .zoom = picture.zoom, .look_at = picture.look_at};
  if (auto const named = named_view(picture.named_view, up)) {
    camera.view.azimuth = (*named)[0];
    camera.view.elevation = (*named)[1];
  }
  camera.view = camera.view.in(dimension);
  if (picture.follow.empty()) return camera;
  auto const body =
      std::find_if(bodies.begin(), bodies.end(), [&](BodySpec const& one) { return one.name == picture.follow; });
  if (body == bodies.end()) {
    std::vector<std::string> names;
    for (BodySpec const& one : bodies) names.push_back(one.name);
    throw InputError(fmt::format("follow: there is no body '{}' (allowed: {}) - choose one of these", picture.follow,
                                 fmt::join(names, ", ")));
  }
  camera.follow = static_cast<int>(body - bodies.begin());
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
          .theme = static_cast<Theme>(number_of(picture.theme, theme_words, "theme")),
          .labels = picture.labels,
          .palette = palette_for(picture.field, static_cast<Palette>(number_of(picture.map, palette_words, "map")))};
}

}  // namespace piola
