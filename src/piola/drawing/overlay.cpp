// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/overlay.hpp"
#include "piola/base/contracts.hpp"
#include "piola/drawing/canvas.hpp"
#include "piola/drawing/ticks.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola {
namespace {

using Corner = std::array<double, 2>;

/// Draws the parts of an overlay.
class Writer {
 public:
  Writer(Canvas& canvas, Layout const& layout, Overlay const& overlay, ThemeColours const& colours)
      : canvas_(canvas), at_(layout), what_(overlay), colours_(colours) {}

  void heading() {
    double const row = 36 * at_.unit, left = 26 * at_.unit, right = at_.width - 22 * at_.unit;
    double const taken = at_.two_rows ? 0 : text_width(what_.at_right, at_.large) + 30 * at_.unit;
    ink(left, row, shortened(what_.title, at_.large, right - left - taken), at_.large);
    ink(right, at_.two_rows ? row + 26 * at_.unit : row, what_.at_right, at_.large, Align::right);
  }

  /// The bar with its marks at its right, and what it shows beside them, upwards.
  void bar() {
    double const u = at_.unit, tip = 17 * u, room = 0.05 * (at_.bottom - at_.top);
    x0_ = at_.right + 22 * u;
    x1_ = x0_ + 20 * u;
    top_ = at_.top + room + tip;
    bottom_ = at_.bottom - room - tip - (what_.not_a_number ? 30 * u : 0);
    if (!(bottom_ > top_ + 10 * u)) return;
    ColourMap const& map = *what_.map;
    auto const unit = shown_unit(std::max(std::abs(map.low()), std::abs(map.high())), what_.unit);
    shades();
    pointed_end(top_, -tip, what_.extremes[1], what_.extremes[1] > map.high(), unit);
    pointed_end(bottom_, tip, what_.extremes[0], what_.extremes[0] < map.low(), unit);
    double const widest = marks(unit);
    std::string const caption = unit.text.empty() ? what_.label : fmt::format("{} [{}]", what_.label, unit.text);
    double const x = std::min(x1_ + 9 * u + widest + 1.5 * at_.text, at_.width - 0.45 * at_.text);
    canvas_.write_upwards(x, (top_ + bottom_) / 2, shortened(caption, at_.text, at_.bottom - at_.top),
                          {at_.text, colours_.ink});
    if (what_.not_a_number) no_number(x0_, bottom_ + tip + 12 * u);
  }

  /// As many names as there is room for.
  void names() {
    double const u = at_.unit, row = 1.7 * at_.text, side = 0.75 * at_.text, x = at_.right + 8 * u;
    auto const room = static_cast<std::size_t>(std::max(1.0, (at_.bottom - at_.top) / row));
    std::size_t const shown = what_.legend.size() <= room ? what_.legend.size() : room - 1;
    double const wide = at_.width - 8 * u - x - 1.6 * side, first = at_.top + row;
    for (std::size_t k = 0; k < shown; ++k) {
      double const y = first + static_cast<double>(k) * row;
      square(x, y, side, what_.legend[k].colour);
      ink(x + 1.6 * side, y, shortened(what_.legend[k].name, at_.text, wide), at_.text);
    }
    if (shown < what_.legend.size())
      ink(x, first + static_cast<double>(shown) * row, fmt::format("and {} more", what_.legend.size() - shown),
          at_.text);
  }

  void axes() {
    double const length = 25 * at_.unit;
    Corner const origin{44 * at_.unit, at_.height - 41 * at_.unit};
    constexpr std::array<char const*, 3> axis_names{"x", "y", "z"};
    for (std::size_t k = 0; k < std::min<std::size_t>(what_.axes.size(), 3); ++k) {
      double const dx = what_.axes[k][0] * length, dy = -what_.axes[k][1] * length, on_paper = std::hypot(dx, dy);
      if (!(on_paper > 0.25 * length)) continue;  // axis towards the viewer: its letter would overlap other letters
      canvas_.line(std::array{origin, Corner{origin[0] + dx, origin[1] + dy}}, 1.6 * at_.unit, colours_.faint_ink);
      double const beyond = 1 + 9 * at_.unit / on_paper;
      canvas_.write(origin[0] + dx * beyond, origin[1] + dy * beyond + 0.3 * at_.small, axis_names[k],
                    {at_.small, colours_.faint_ink}, Align::centre);
    }
  }

  /// A line whose length is a round number of metres.
  void scale_bar() {
    double const fifth = 0.22 * (at_.right - at_.left) / what_.pixels_per_metre;
    if (!(what_.pixels_per_metre > 0) || !(fifth > 0) || !std::isfinite(fifth)) return;
    double const power = std::pow(10.0, std::floor(std::log10(fifth)));
    double const digit = fifth >= 5 * power ? 5 : fifth >= 2 * power ? 2 : 1, metres = digit * power;
    auto const prefix = prefix_for(metres * (1 + 1e-9), "m");
    double const long_ = metres * what_.pixels_per_metre, u = at_.unit;
    double const x1 = at_.right - 4 * u, x0 = x1 - long_, y = at_.height - 22 * u, end = 4 * u;
    std::array const bracket{Corner{x0, y - end}, Corner{x0, y}, Corner{x1, y}, Corner{x1, y - end}};
    canvas_.line(bracket, std::max(1.5 * u, 0.8), colours_.faint_ink);
    std::string const words = fmt::format("{:.6g} {}m", metres / prefix.factor, prefix.word);
    canvas_.write((x0 + x1) / 2, y - 8 * u, words, {at_.small, colours_.faint_ink}, Align::centre);
  }

 private:
  void ink(double x, double y, std::string_view text, double size, Align align = Align::left) {
    canvas_.write(x, y, text, {size, colours_.ink}, align);
  }
  void faint(double x, double y, std::string_view text) { canvas_.write(x, y, text, {at_.small, colours_.faint_ink}); }
  void square(double x, double y, double side, Colour colour) {
    canvas_.area(std::array{Corner{x, y - side}, Corner{x + side, y - side}, Corner{x + side, y}, Corner{x, y}},
                 colour);
  }
  void shades() {
    ColourMap const& map = *what_.map;
    int const rows = std::max(2, static_cast<int>(bottom_ - top_));
    for (int k = 0; k < rows; ++k) {
      // Each row reaches into the next one, so that no seam shows through.
      double const row = (bottom_ - top_) / rows, y0 = bottom_ - row * k, y1 = std::max(top_, y0 - 1.5 * row);
      double const value = map.low() + (map.high() - map.low()) * (k + 0.5) / rows;
      canvas_.area(std::array{Corner{x0_, y0}, Corner{x1_, y0}, Corner{x1_, y1}, Corner{x0_, y1}}, map(value));
    }
  }
  /// An end of the bar at y with a tip that reaches `tip` further, where values lie beyond it.
  void pointed_end(double y, double tip, double value, bool beyond, ShownUnit const& unit) {
    if (!beyond) return;
    double const seam = tip > 0 ? y - 1 : y + 1;
    canvas_.area(std::array{Corner{x0_, seam}, Corner{x1_, seam}, Corner{(x0_ + x1_) / 2, y + tip}},
                 (*what_.map)(value));
    faint(x1_ + 9 * at_.unit, y + 0.5 * tip + (tip > 0 ? 0.7 * at_.small : 0), extreme(value, unit));
  }
  /// Returns the width of the widest number.
  double marks(ShownUnit const& unit) {
    ColourMap const& map = *what_.map;
    double const u = at_.unit;
    double widest = 0;
    for (Tick const& tick : linear_ticks(map.low() / unit.factor, map.high() / unit.factor)) {
      double const share = (tick.value * unit.factor - map.low()) / (map.high() - map.low());
      double const y = bottom_ - share * (bottom_ - top_);
      canvas_.line(std::array{Corner{x1_, y}, Corner{x1_ + 5 * u, y}}, std::max(1.2 * u, 0.8), colours_.ink);
      ink(x1_ + 9 * u, y + 0.36 * at_.text, tick.text, at_.text);
      widest = std::max(widest, text_width(tick.text, at_.text));
    }
    return widest;
  }
  void no_number(double x, double y) {
    square(x, y + at_.small, at_.small, (*what_.map)(std::nan("")));
    faint(x + 1.5 * at_.small, y + 0.9 * at_.small, "not a number");
  }
  static std::string extreme(double value, ShownUnit const& unit) {
    std::string text = fmt::format("{:.3g}", value / unit.factor);
    if (text.starts_with('-')) text.replace(0, 1, "\u2212");
    return "to " + text;
  }

  Canvas& canvas_;
  Layout const& at_;
  Overlay const& what_;
  ThemeColours const& colours_;
  double x0_ = 0, x1_ = 0, top_ = 0, bottom_ = 0;  // of the bar
};

}  // namespace

ThemeColours colours_of(Theme theme) {
  if (theme == Theme::dark) return {{24, 26, 31}, {226, 229, 234}, {150, 156, 166}};
  return {{255, 255, 255}, {40, 44, 52}, {110, 116, 126}};
}

std::string TimeFormat::text(double time) const {
  PIOLA_EXPECTS(factor > 0 && decimals >= 0);
  return fmt::format("{:.{}f} {}", time / factor, decimals, unit);
}

TimeFormat time_format(double longest, double step) {
  constexpr int most = 6;
  auto const prefix = prefix_for(longest * (1 + 1e-9), "s");
  TimeFormat format{prefix.factor, fmt::format("{}s", prefix.word), 0};
  if (!(longest > 0)) return {};
  double const shown = step > 0 ? step / format.factor : longest / format.factor;
  for (double power = 1; format.decimals < most; ++format.decimals, power *= 10)
    if (std::abs(shown * power - std::round(shown * power)) <= 0.01 * shown * power) break;
  return format;
}

Layout layout_of(int width, int height, std::string_view title, bool letters) {
  PIOLA_EXPECTS(width > 0 && height > 0);
  Layout at{.width = width, .height = height};
  double const area = std::sqrt(static_cast<double>(width) * height / 800000.0);
  at.unit = std::min({std::max(area, 0.5), width / 400.0, height / 300.0});
  at.small *= at.unit;
  at.text *= at.unit;
  at.large *= at.unit;
  if (!letters) {
    double const edge = 0.02 * std::min(width, height);
    at.left = at.top = edge;
    at.right = width - edge;
    at.bottom = height - edge;
    return at;
  }
  at.two_rows = text_width(title, at.large) + 200 * at.unit > width;  // the same for all times
  at.left = 24 * at.unit;
  at.right = width - 150 * at.unit;
  at.top = (at.two_rows ? 80 : 54) * at.unit;
  at.bottom = height - 78 * at.unit;
  return at;
}

Image draw_marks(int width, int height, Layout const& layout, Overlay const& overlay, ThemeColours const& colours,
                 bool transparent) {
  PIOLA_EXPECTS(width > 0 && height > 0);
  Image strip(width, height, colours.background);
  if (transparent) strip.alpha.assign(strip.rgb.size() / 3, 0);
  Layout at = layout;
  at.width = width;
  at.height = height;
  at.left = 0;
  at.right = width;
  Canvas canvas(strip);
  Writer writer(canvas, at, overlay, colours);
  writer.axes();
  writer.scale_bar();
  return canvas.image();
}

void draw_overlay(Image& image, Layout const& layout, Overlay const& overlay, ThemeColours const& colours) {
  Canvas canvas(image);
  Writer writer(canvas, layout, overlay, colours);
  writer.heading();
  if (overlay.legend.empty() && overlay.map)
    writer.bar();
  else
    writer.names();
  writer.axes();
  writer.scale_bar();
  image = canvas.image();
}

}  // namespace piola
