// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/look.hpp"
#include "piola/base/problems.hpp"
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

OutputSpec with_look(OutputSpec output, LookOptions const& look) {
  auto const take = [](auto& target, auto const& given) {
    if (given) target = *given;
  };
  auto const take_word = [](std::string& target, std::string const& given) {
    if (!given.empty()) target = given;
  };
  if (look.view) output.picture_named_view.clear();
  take(output.picture_view, look.view);
  if (!look.named_view.empty()) number_of(look.named_view, view_words, "view");
  take_word(output.picture_named_view, look.named_view);
  if (look.up != "auto") output.picture_up = look.up;
  take(output.picture_roll, look.roll);
  take(output.picture_zoom, look.zoom);
  take(output.picture_perspective, look.perspective);
  take(output.picture_labels, look.labels);
  if (look.look_at) output.picture_look_at = look.look_at;
  take_word(output.picture_follow, look.follow);
  take_word(output.picture_theme, look.theme);
  take_word(output.picture_map, look.map);
  number_of(output.picture_theme, theme_words, "theme");
  number_of(output.picture_map, palette_words, "map");
  if (look.size) {
    output.picture_width = (*look.size)[0];
    output.picture_height = (*look.size)[1];
  }
  return output;
}

Camera camera_of(OutputSpec const& output, Up up, std::span<BodySpec const> bodies, int dimension) {
  Camera camera{.view = {output.picture_view[0], output.picture_view[1], up, output.picture_roll},
                .zoom = output.picture_zoom,
                .look_at = output.picture_look_at};
  if (auto const named = named_view(output.picture_named_view, up)) {
    camera.view.azimuth = (*named)[0];
    camera.view.elevation = (*named)[1];
  }
  camera.view = camera.view.in(dimension);
  if (output.picture_follow.empty()) return camera;
  auto const body = std::find_if(bodies.begin(), bodies.end(),
                                 [&](BodySpec const& one) { return one.name == output.picture_follow; });
  if (body == bodies.end()) {
    std::vector<std::string> names;
    for (BodySpec const& one : bodies) names.push_back(one.name);
    throw InputError(fmt::format("follow: there is no body '{}' (allowed: {}) - choose one of these",
                                 output.picture_follow, fmt::join(names, ", ")));
  }
  camera.follow = static_cast<int>(body - bodies.begin());
  return camera;
}

PictureStyle style_of(OutputSpec const& output, Camera const& camera, Window const& window) {
  std::array<int, 2> size{output.picture_width, output.picture_height};
  if (size[0] <= 0 || size[1] <= 0) {
    size = fitting_size(window);
    for (int& side : size) side = 2 * std::max(1, static_cast<int>(std::lround(output.picture_scale * side / 2)));
  }
  return {.width = size[0],
          .height = size[1],
          .view = camera.view,
          .range = output.picture_range,
          .theme = static_cast<Theme>(number_of(output.picture_theme, theme_words, "theme")),
          .labels = output.picture_labels,
          .palette = palette_for(output.picture_field,
                                 static_cast<Palette>(number_of(output.picture_map, palette_words, "map")))};
}

}  // namespace piola
