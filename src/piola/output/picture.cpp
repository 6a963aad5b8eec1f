// SPDX-License-Identifier: Apache-2.0
#include "piola/output/picture.hpp"
#include "piola/base/text.hpp"
#include "piola/output/colour_map.hpp"
#include "piola/output/draw_bodies.hpp"
#include "piola/output/lettering.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>

namespace piola {
namespace {

using Point = std::array<double, 3>;
using Pixel = std::array<double, 2>;

constexpr Colour ink{40, 44, 52}, faint_ink{110, 116, 126};

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// All sizes follow the height of the picture, so that a large one is not one with tiny letters.
struct Layout {
  double unit, text, left, right, top, bottom;
  explicit Layout(PictureStyle const& style)
      : unit(std::min(style.height / 800.0, style.width / 900.0)),
        text(13 * unit),
        left(30 * unit),
        right(style.width - 165 * unit),
        top(70 * unit),
        bottom(style.height - 40 * unit) {}
};

/// The window is centred in the free area.
Projection make_projection(View const& view, Window const& w, Layout const& area) {
  Projection p{view.right(), view.up(), view.towards_viewer()};
  double const wide = std::max(w.x1 - w.x0, 1e-300), high = std::max(w.y1 - w.y0, 1e-300);
  p.scale = std::min((area.right - area.left) / wide, (area.bottom - area.top) / high);
  p.x_shift = (area.left + area.right) / 2 - p.scale * (w.x0 + w.x1) / 2;
  p.y_shift = (area.top + area.bottom) / 2 + p.scale * (w.y0 + w.y1) / 2;
  return p;
}

/// Tick numbers with as many decimals as their distance needs.
std::string tick_text(double value, double step) {
  double const size = std::max(std::abs(value), step);
  if (size >= 1e5 || step < 1e-4) return fmt::format("{:.3g}", value);
  int const decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  return fmt::format("{:.{}f}", value, decimals);
}

void draw_colour_bar(Image& image, PictureData const& data, ColourMap const& map, Layout const& layout) {
  double const u = layout.unit;
  int const x0 = static_cast<int>(image.width - 125 * u), x1 = static_cast<int>(image.width - 101 * u);
  int const top = static_cast<int>(image.height * 0.2), bottom = static_cast<int>(image.height * 0.86);
  auto const row = [&](double value) {
    return bottom - (value - map.low()) / (map.high() - map.low()) * (bottom - top);
  };
  for (int y = top; y <= bottom; ++y) {
    Colour const colour = map(map.low() + (map.high() - map.low()) * (bottom - y) / (bottom - top));
    for (int x = x0; x <= x1; ++x) image.set(x, y, colour);
  }
  auto const unit = shown_unit(std::max(std::abs(map.low()), std::abs(map.high())), data.unit);
  auto const ticks = map.ticks();
  double const step = ticks.size() > 1 ? (ticks[1] - ticks[0]) / unit.factor : 1;
  for (double const tick : ticks) {
    double const y = row(tick);
    draw_line(image, {x1 + 2.0, y + 0.5}, {x1 + 5 * u, y + 0.5}, std::max(1.2 * u, 1.0), ink);
    draw_text(image, x1 + 15 * u, y + 0.5 * layout.text, tick_text(tick / unit.factor, step), layout.text, ink);
  }
  std::string const caption = unit.text.empty() ? data.label : fmt::format("{} [{}]", data.label, unit.text);
  double const right_edge = image.width - 20 * u, wide = text_width(caption, layout.text);
  bool const fits = x0 + wide <= right_edge;
  draw_text(image, fits ? x0 : right_edge, top - 20 * u, caption, layout.text, ink, fits ? Align::left : Align::right);
}

/// The part of a title that fits, with dots if some is left out.
std::string shortened(std::string text, double height, double width) {
  if (text_width(text, height) <= width) return text;
  while (!text.empty() && text_width(text + "...", height) > width) text.pop_back();
  return text + "...";
}

/// As many names as there is room for.
void draw_legend(Image& image, std::span<LegendEntry const> legend, Layout const& layout) {
  double const u = layout.unit, row = 1.9 * layout.text, side = 0.5 * layout.text, x = image.width - 155 * u;
  auto const room = static_cast<std::size_t>(std::max(1.0, (layout.bottom - layout.top) / row));
  std::size_t const shown = legend.size() <= room ? legend.size() : room - 1;
  double const wide = image.width - 8 * u - x - 3.5 * side, first = layout.top + row;
  for (std::size_t k = 0; k < shown; ++k) {
    double const y = first + static_cast<double>(k) * row;
    draw_line(image, {x + side, y - side}, {x + side + 0.1, y - side}, 2 * side, legend[k].colour);
    draw_text(image, x + 3.5 * side, y, shortened(legend[k].name, layout.text, wide), layout.text, ink);
  }
  if (shown < legend.size())
    draw_text(image, x, first + static_cast<double>(shown) * row, fmt::format("and {} more", legend.size() - shown),
              layout.text, ink);
}

void draw_axes(Image& image, View const& view, int dimension, Layout const& layout) {
  double const length = 34 * layout.unit;
  Pixel const origin{52 * layout.unit, image.height - 50 * layout.unit};
  constexpr std::array<char const*, 3> names{"x", "y", "z"};
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
    double const dx = view.right()[k] * length, dy = -view.up()[k] * length;
    if (std::hypot(dx, dy) < 0.1 * length) continue;  // points at the viewer
    draw_line(image, origin, {origin[0] + dx, origin[1] + dy}, 1.8 * layout.unit, faint_ink);
    double const beyond = 1 + 11 * layout.unit / std::hypot(dx, dy);
    draw_text(image, origin[0] + dx * beyond, origin[1] + dy * beyond + 4 * layout.unit, names[k], 11 * layout.unit,
              faint_ink, Align::centre);
  }
}

/// A direction given for y upwards, turned so that another axis points upwards.
Point turned(Up up, Point const& d) {
  switch (up) {
    case Up::z: return {d[0], -d[2], d[1]};
    case Up::x: return {d[1], -d[0], d[2]};
    case Up::minus_y: return {-d[0], -d[1], d[2]};
    case Up::minus_z: return {d[0], d[2], -d[1]};
    case Up::minus_x: return {-d[1], d[0], d[2]};
    default: return d;
  }
}

}  // namespace

View View::in(int dimension) const {
  if (dimension == 3) return *this;
  return {0, 0, upwards == Up::z ? Up::y : upwards == Up::minus_z ? Up::minus_y : upwards};
}

std::array<double, 3> View::right() const {
  double const a = radians(azimuth);
  return turned(upwards, {std::cos(a), 0, -std::sin(a)});
}

std::array<double, 3> View::towards_viewer() const {
  double const a = radians(azimuth), e = radians(elevation);
  return turned(upwards, {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)});
}

std::array<double, 3> View::up() const {
  double const a = radians(azimuth), e = radians(elevation);
  return turned(upwards, {-std::sin(e) * std::sin(a), std::cos(e), -std::sin(e) * std::cos(a)});
}

void Window::include(View const& view, std::span<Point const> points, double margin) {
  double const infinity = std::numeric_limits<double>::infinity();
  double low_x = infinity, high_x = -infinity, low_y = infinity, high_y = -infinity;
  for (Point const& p : points) {
    double const x = dot(p, view.right()), y = dot(p, view.up());
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    low_x = std::min(low_x, x - margin);
    high_x = std::max(high_x, x + margin);
    low_y = std::min(low_y, y - margin);
    high_y = std::max(high_y, y + margin);
  }
  if (!(low_x <= high_x)) return;
  bool const inside = set && low_x >= x0 && high_x <= x1 && low_y >= y0 && high_y <= y1;
  if (inside) return;
  double const room = 0.06 * std::max(high_x - low_x, high_y - low_y);
  auto const grow = [&](double& low, double& high, double new_low, double new_high) {
    low = set && low <= new_low ? low : new_low - room;
    high = set && high >= new_high ? high : new_high + room;
  };
  grow(x0, x1, low_x, high_x);
  grow(y0, y1, low_y, high_y);
  set = true;
}

Image draw_picture(PictureData const& data, PictureStyle const& asked, Window const& window) {
  PictureStyle style = asked;
  style.view = style.view.in(data.dimension);
  Layout const layout(style);
  auto const range = style.range ? *style.range : typical_range(data.values);
  ColourMap const map(range[0], range[1]);
  SceneArea const area{style.width, style.height, static_cast<int>(0.8 * layout.top), static_cast<int>(layout.right)};
  Image image = draw_bodies(data, style.appearance, make_projection(style.view, window, layout), area, map);
  bool const named = !data.colours.empty();
  if (named)
    draw_legend(image, data.legend, layout);
  else
    draw_colour_bar(image, data, map, layout);
  draw_axes(image, style.view, data.dimension, layout);
  std::string const time = named ? data.label : "t = " + quantity_text(data.time, "s");
  double const right = style.width - 20 * layout.unit, baseline = 38 * layout.unit, large = 1.3 * layout.text;
  draw_text(image, right, baseline, time, large, ink, Align::right);
  double const room = right - text_width(time, large) - 60 * layout.unit;
  draw_text(image, 30 * layout.unit, baseline, shortened(data.title, large, room), large, ink);
  return image;
}

std::vector<double> ball_radii(std::span<double const> volume, std::span<int const> body, int dimension) {
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
  std::string const words = field_words(field);
  if (component != whole_field) return words + " " + component_word(field, components, component);
  if (components == 3) return words + " magnitude";
  if (components == 6) return "von Mises of " + words;
  return components == 1 ? words : "largest " + words;
}

std::string picture_name(std::string const& field, int components, int component, std::size_t number) {
  if (component == whole_field) return fmt::format("{}-{:06}.png", field, number);
  return fmt::format("{}-{}-{:06}.png", field, component_word(field, components, component), number);
}

}  // namespace piola
