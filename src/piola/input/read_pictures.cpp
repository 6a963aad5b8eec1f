// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/formulations/quantity_names.hpp"
#include "piola/input/history_names.hpp"
#include "piola/input/output_keys.hpp"
#include "piola/input/sections.hpp"
#include <algorithm>
#include <span>

namespace piola {
namespace {

std::string_view unit_of_field(std::string_view name) {
  for (FieldName const& field : field_names()) {
    if (field.name == name) return field.unit;
  }
  return "1";
}

/// Two numbers, for instance the ends of a range.
std::optional<std::array<double, 2>> read_pair(Section const& section, std::string_view key, std::string_view unit) {
  auto const value = section.find(key);
  if (!value) return std::nullopt;
  auto const items = read_list(*value, 2, 2, section.problems());
  if (!items) return std::nullopt;
  Interval const allowed = key_info("output.pictures", key).allowed;
  auto const first = read_number((*items)[0], unit, allowed, section.problems());
  auto const second = read_number((*items)[1], unit, allowed, section.problems());
  if (!first || !second) return std::nullopt;
  return std::array{*first, *second};
}

void read_size(Section const& section, PictureSpec& picture) {
  auto const value = section.find("size");
  if (!value) return;
  auto const items = read_list(*value, 2, 2, section.problems());
  if (!items) return;
  Interval const allowed = key_info("output.pictures", "size").allowed;
  auto const width = read_whole((*items)[0], allowed, section.problems());
  auto const height = read_whole((*items)[1], allowed, section.problems());
  if (width) picture.width = static_cast<int>(*width);
  if (height) picture.height = static_cast<int>(*height);
}

// Plain numbers are in degrees here, unlike SI, as is usual for views.
void read_view(Section const& section, PictureSpec& picture) {
  auto const view = section.find("view");
  if (view && view->node.kind == Node::Kind::text) {
    if (auto const word = read_word(*view, to_strings(view_words), section.problems())) picture.named_view = *word;
    for (char const* const key : {"azimuth", "elevation"}) section.refuse(key, "is given by the name of the view");
  } else if (view) {
    picture.named_view.clear();
    auto const items = read_list(*view, 2, 2, section.problems());
    Interval const allowed = key_info("output.pictures", "view").allowed;
    for (std::size_t i = 0; items && i < 2; ++i) {
      if (auto const angle = read_number((*items)[i], "degree", allowed, section.problems())) picture.view[i] = *angle;
    }
    for (char const* const key : {"azimuth", "elevation"}) section.refuse(key, "is given by view");
  }
  if (section.read("azimuth", picture.view[0])) picture.named_view.clear();
  if (section.read("elevation", picture.view[1])) picture.named_view.clear();
}

void read_centre(Section const& section, PictureSpec& picture, std::span<BodySpec const> bodies) {
  if (auto const point = section.point("look_at")) {
    picture.look_at = std::array{0.0, 0.0, 0.0};
    std::copy(point->begin(), point->end(), picture.look_at->begin());
  }
  std::vector<std::string> known;
  for (BodySpec const& body : bodies)
    if (!body.name.empty()) known.push_back(body.name);
  if (auto const body = section.find("follow"))
    if (auto const word = read_word(*body, known, section.problems())) picture.followed_body = *word;
}

void check_component(Section const& section, PictureSpec const& picture) {
  for (FieldName const& field : field_names()) {
    if (field.name != picture.field || find_component(picture.component, field.components)) continue;
    std::string known;
    for (std::string_view const word : component_words(field.components)) {
      known += known.empty() ? "" : ", ";
      known += word;
    }
    section.problems().add(section.place_of("component"),
                           section.name_of("component") + " is " + in_quotes(picture.component) + " (" +
                               std::string(field.name) + " has " + (known.empty() ? "no components" : known) + ")" +
                               (known.empty() ? " - leave it out" : ""));
  }
}

void check_revolve(Section const& section, std::span<BodySpec const> bodies, PictureSpec const& picture) {
  if (!(picture.revolve > 0) || bodies.empty()) return;
  std::string const name = section.name_of("revolve");
  if (!bodies.front().shape.axisymmetric)
    section.problems().add(section.place_of("revolve"),
                           name + " is " + number_text(picture.revolve, 6) +
                               " degree (allowed with geometry = \"axisymmetric\" only) - remove it");
  else if (picture.appearance.cut)
    section.problems().add(section.place_of("revolve"),
                           name + " is " + number_text(picture.revolve, 6) +
                               " degree beside a cut (allowed: one of both) - below 360 degree bodies are cut open");
}

/// Reads the keys common to a picture and a panel. A panel with another field does not take component and range from
/// the picture.
void read_picture(Section const& section, std::span<PictureKey const> keys, std::span<BodySpec const> bodies,
                  PictureSpec& picture) {
  read_members(section, keys, picture);
  if (auto const field = section.find("field")) {
    std::string const before = picture.field;
    if (auto const word = read_word(*field, known_fields(), section.problems())) picture.field = *word;
    if (picture.field != before) {
      picture.component.clear();
      picture.range.reset();
    }
  }
  if (section.read("component", picture.component)) picture.range.reset();
  check_component(section, picture);
  if (auto const range = read_pair(section, "range", unit_of_field(picture.field))) picture.range = range;
  if (picture.range && (*picture.range)[0] >= (*picture.range)[1]) {
    section.problems().add(section.place_of("range"),
                           section.name_of("range") + " is empty (allowed: the lower value first)");
  }
  read_view(section, picture);
  read_centre(section, picture, bodies);
  if (picture.ground && !bodies.empty() && bodies.front().shape.dimension < 3 && !(picture.revolve > 0))
    section.problems().add(section.place_of("ground"),
                           section.name_of("ground") + " is true (allowed in three dimensions only) - remove it");
  read_appearance(section, bodies, picture.appearance);
  check_revolve(section, bodies, picture);
}

void read_panels(Section const& section, PicturesSpec& pictures, std::span<BodySpec const> bodies) {
  constexpr std::size_t most = 16;
  for (Section const& panel : tables_in(section, "panel", most)) {
    pictures.panels.push_back(static_cast<PictureSpec const&>(pictures));
    read_picture(panel, panel_keys(), bodies, pictures.panels.back());
    panel.refuse_unknown();
  }
  if (pictures.panels.empty()) section.refuse("columns", "is used only with panels");
}

void read_times(Section const& section, PicturesSpec& pictures) {
  constexpr std::size_t most = 16;
  auto const value = section.find("times");
  auto const items = value ? read_list(*value, 1, most, section.problems()) : std::nullopt;
  for (std::size_t k = 0; items && k < items->size(); ++k)
    if (auto const time = read_number((*items)[k], "s", section.info_of("times").allowed, section.problems()))
      pictures.times.push_back(*time);
  if (section.has("panel")) section.refuse("times", "has no meaning beside panels");
}

}  // namespace

void read_pictures(Section const& section, PicturesSpec& pictures, std::span<BodySpec const> bodies) {
  read_size(section, pictures);
  read_picture(section, picture_keys(), bodies, pictures);
  read_panels(section, pictures, bodies);
  read_members(section, pictures_keys(), pictures);
  read_times(section, pictures);
  section.refuse_unknown();
}

}  // namespace piola
