// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/picture.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/version.hpp"
#include "piola/drawing/colour_map.hpp"
#include "piola/drawing/draw_bodies.hpp"
#include "piola/formulations/field_signs.hpp"
#include "piola/output/checksum_trailer.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>

namespace piola {
namespace {

using Point = std::array<double, 3>;
using Pixel = std::array<double, 2>;

/// The window is centred in the free area.
Projection make_projection(View const& view, Window const& w, Layout const& area) {
  Projection p{view.right(), view.up(), view.towards_viewer()};
  double const wide = std::max(w.x1 - w.x0, 1e-300), high = std::max(w.y1 - w.y0, 1e-300);
  p.scale = std::min((area.right - area.left) / wide, (area.bottom - area.top) / high);
  p.x_shift = (area.left + area.right) / 2 - p.scale * (w.x0 + w.x1) / 2;
  p.y_shift = (area.top + area.bottom) / 2 + p.scale * (w.y0 + w.y1) / 2;
  return p;
}

Spread spread_of(PictureData const& data) {
  if (data.spread) return *data.spread;
  Spread spread;
  spread.include(data.values);
  return spread;
}

ColourMap map_of(PictureStyle const& style, Spread const& spread) {
  auto const range = style.range ? *style.range : spread.typical;
  return {range[0], range[1], style.palette};
}

/// Settings common to a picture and its letters.
struct Setting {
  View view;
  Layout layout;
  Spread spread;
  ColourMap map;
  Projection project;
  Setting(PictureData const& data, PictureStyle const& style, Window const& window)
      : view(style.view.in(data.dimension)),
        layout(layout_of(style.width, style.height, data.title, style.labels)),
        spread(spread_of(data)),
        map(map_of(style, spread)),
        project(make_projection(view, window, layout)) {
    project.eye = data.eye;
  }
};

Image draw_scene(PictureData const& data, PictureStyle const& style, Layout const& layout, Projection const& project,
                 ColourMap const& map, std::optional<Colour> background) {
  double const top = style.labels ? 0.8 * layout.top : 0, right = style.labels ? layout.right : style.width;
  SceneArea const area{style.width, style.height, static_cast<int>(top), static_cast<int>(right),
                       style.labels ? static_cast<int>(layout.bottom) : 0};
  return draw_bodies(data, style.appearance, project, area, map, background);
}

Overlay overlay_of(PictureData const& data, View const& view, Projection const& project, ColourMap const& map,
                   Spread const& spread) {
  Overlay out;
  for (std::size_t k = 0; k < static_cast<std::size_t>(data.dimension); ++k)
    out.axes.push_back({view.right()[k], view.up()[k]});
  bool const named = !data.colours.empty();
  out.title = data.title;
  TimeFormat const format = data.time_format ? *data.time_format : time_format(data.time, data.time);
  out.at_right = named ? data.label : "t = " + format.text(data.time);
  out.map = named ? nullptr : &map;
  out.label = data.label;
  out.unit = data.unit;
  double const rounding = 1e-3 * (map.high() - map.low());  // differences too small to be visible on the bar
  out.extremes = {spread.extremes[0] < map.low() - rounding ? spread.extremes[0] : map.low(),
                  spread.extremes[1] > map.high() + rounding ? spread.extremes[1] : map.high()};
  out.not_a_number = spread.not_a_number;
  out.legend = data.legend;
  out.pixels_per_metre = project.eye.near() ? 0 : project.scale;  // sizes differ with the distance
  return out;
}

/// Clears the area of letters from particles that have left the window or lie outside an enlarged one.
void clear_for_letters(Image& image, Layout const& layout, std::optional<Colour> background) {
  double const air = 8 * layout.unit;
  for (int y = 0; y < image.height; ++y) {
    bool const beside = !(y < layout.top - air || y > layout.bottom + air);
    for (int x = beside ? static_cast<int>(layout.right + air) + 1 : 0; x < image.width; ++x) {
      image.set(x, y, background.value_or(Colour{}));
      if (!background)
        image.alpha[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)] =
            0;
    }
  }
}

/// Adds notes on the origin of a picture.
void add_notes_to(Image& image, PictureData const& data, ColourMap const& map) {
  image.notes.emplace_back("Title", data.title);
  image.notes.emplace_back("Software", "Piola " + std::string(version()));
  if (data.colours.empty()) {
    image.notes.emplace_back("Time", fmt::format("{} s", data.time));
    image.notes.emplace_back("Field", data.label);
    image.notes.emplace_back("Range", fmt::format("{} to {} {}", map.low(), map.high(), data.unit));
  }
  if (data.case_text.empty()) return;
  CheckSum sum;
  sum.add(data.case_text);
  image.notes.emplace_back("Case", fmt::format("CRC-32 {:08x}", sum.value()));
}

}  // namespace

Image draw_picture(PictureData const& data, PictureStyle const& style, Window const& window) {
  PIOLA_EXPECTS(style.width > 0 && style.height > 0);
  Setting const s(data, style, window);
  ThemeColours const colours = colours_of(style.theme);
  std::optional<Colour> background = colours.background;
  if (style.theme == Theme::transparent) background.reset();
  Image image = draw_scene(data, style, s.layout, s.project, s.map, background);
  if (style.labels) clear_for_letters(image, s.layout, background);
  if (style.labels) draw_overlay(image, s.layout, overlay_of(data, s.view, s.project, s.map, s.spread), colours);
  add_notes_to(image, data, s.map);
  return image;
}

void draw_letters(Image& image, Layout const& layout, PictureData const& data, PictureStyle const& style,
                  Window const& window, std::string const& at_right, bool marks) {
  Setting const s(data, style, window);
  Overlay overlay = overlay_of(data, s.view, s.project, s.map, s.spread);
  overlay.at_right = at_right;
  if (!marks) {
    overlay.axes.clear();
    overlay.pixels_per_metre = 0;
  }
  draw_overlay(image, layout, overlay, colours_of(style.theme));
}

Image draw_marks(Layout const& layout, int height, PictureData const& data, PictureStyle const& style,
                 Window const& window) {
  PIOLA_EXPECTS(height > 0);
  Setting const s(data, style, window);
  return draw_marks(style.width, height, layout, overlay_of(data, s.view, s.project, s.map, s.spread),
                    colours_of(style.theme), style.theme == Theme::transparent);
}

void Spread::include(std::span<double const> values) {
  bool any = false;
  for (double const v : values) {
    not_a_number = not_a_number || std::isnan(v);
    if (!std::isfinite(v)) continue;
    any = true;
    extremes = {std::min(extremes[0], v), std::max(extremes[1], v)};
  }
  if (!any) return;
  auto const range = typical_range(values);
  typical = {std::min(typical[0], range[0]), std::max(typical[1], range[1])};
}

void Spread::include(Spread const& other) {
  typical = {std::min(typical[0], other.typical[0]), std::max(typical[1], other.typical[1])};
  extremes = {std::min(extremes[0], other.extremes[0]), std::max(extremes[1], other.extremes[1])};
  not_a_number = not_a_number || other.not_a_number;
}

std::vector<double> ball_radii(std::span<double const> volume, std::span<int const> body, int dimension) {
  PIOLA_EXPECTS(volume.size() == body.size());
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  std::map<int, double> largest;
  for (std::size_t i = 0; i < volume.size(); ++i) largest[body[i]] = std::max(largest[body[i]], volume[i]);
  // Half the spacing would leave gaps; flat discs must reach the middle of a lattice cell.
  double const share = dimension == 3 ? 0.58 : 0.72;
  for (auto& entry : largest) entry.second = share * std::pow(entry.second, 1.0 / dimension);
  std::vector<double> out(volume.size());
  for (std::size_t i = 0; i < volume.size(); ++i) out[i] = largest[body[i]];
  return out;
}

std::vector<double> picture_values(std::span<double const> values, int components, int component) {
  PIOLA_EXPECTS(components >= 1 && values.size() % static_cast<std::size_t>(components) == 0);
  PIOLA_EXPECTS(component == whole_field || (component >= 0 && component < components));
  auto const width = static_cast<std::size_t>(components);
  std::vector<double> out(values.size() / width);
  for (std::size_t i = 0; i < out.size(); ++i) {
    double const* v = &values[i * width];
    if (component != whole_field) {
      out[i] = v[component];
    } else if (width == 1) {
      out[i] = v[0];
    } else if (width == 3) {
      out[i] = std::hypot(v[0], v[1], v[2]);
    } else if (width == 6) {
      double const a = v[0] - v[1], b = v[1] - v[2], c = v[2] - v[0];
      out[i] = std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * (v[3] * v[3] + v[4] * v[4] + v[5] * v[5]));
    } else {
      for (std::size_t k = 0; k < width; ++k) out[i] = std::max(out[i], std::abs(v[k]));
    }
  }
  return out;
}

std::array<double, 2> typical_range(std::span<double const> values) {
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite), [](double v) { return std::isfinite(v); });
  if (finite.empty()) return {0, 0};
  auto const skipped = static_cast<std::ptrdiff_t>(finite.size() / 100);
  auto const low = finite.begin() + skipped, high = finite.end() - 1 - skipped;
  std::nth_element(finite.begin(), low, finite.end());
  double const lowest = *low;
  std::nth_element(finite.begin(), high, finite.end());
  return {lowest, *high};
}

namespace {

/// "x", "xy"; of principal values "1", "2", "3".
std::string component_word(std::string const& field, int components, int component) {
  if (field.starts_with("Principal")) return std::to_string(component + 1);
  return std::string(component_words(components)[static_cast<std::size_t>(component)]);
}

}  // namespace

std::string picture_label(std::string const& field, int components, int component) {
  PIOLA_EXPECTS(component == whole_field || (component >= 0 && component < components));
  std::string const words = field_words(field);
  std::string_view const sign = sign_of(field, component);
  std::string const signed_by = sign.empty() ? "" : fmt::format(", {}", sign);
  if (component != whole_field) return words + " " + component_word(field, components, component) + signed_by;
  if (components == 3) return words + " magnitude";
  if (components == 6) return "von Mises of " + words;
  return components == 1 ? words + signed_by : "largest " + words;
}

std::string picture_name(std::string const& field, int components, int component, std::size_t number) {
  PIOLA_EXPECTS(component == whole_field || (component >= 0 && component < components));
  if (component == whole_field) return fmt::format("{}-{:06}.png", field, number);
  return fmt::format("{}-{}-{:06}.png", field, component_word(field, components, component), number);
}

}  // namespace piola
