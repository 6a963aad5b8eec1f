// SPDX-License-Identifier: Apache-2.0
#include "piola/output/lettering.hpp"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace piola {
namespace {

using StrokePoint = std::array<double, 2>;
using Stroke = std::vector<StrokePoint>;

/// Strokes of the characters from '!' to '~'. A point is a digit (x) and a letter (y: 'c' the baseline, 'h' the top of
/// small letters, 'j' that of capitals); strokes are separated by blanks; '~' before a stroke makes it the quadratic
/// B-spline of its points, closed if the last point is the first. A stroke of two equal points is a dot.
// clang-format off
constexpr std::array<std::string_view, 94> glyphs{
    // ! " # $ %
    "0j0e 0c0c", "0j0h 2j2h", "1c2j 3c4j 0e5e 0h5h", "~4h4i0i0g4f4d0d0e 2j2c", "0c5j ~0h0j2j2h0h ~3c3e5e5c3c",
    // & ' ( ) * + , - . /
    "~5c1h1j4j4h0f0c4c5f", "0j0h", "~2j0h0d2b", "~0j2h2d0b", "2h2d 0g4e 0e4g", "0f4f 2d2h", "1c0a", "0f3f", "0c0c",
    "0b3j",
    // 0 1 2 3 4
    "~0c0j4j4c0c", "0h2j2c", "~0h0j4j4g0c 0c4c", "~0i0j4j4g1g ~1g4g4c0c0d", "3c3j0e4e",
    // 5 6 7 8 9
    "4j0j0g ~0g1h4h4c0c0d", "~4i4j0j0c4c4g0g0e", "0j4j1c", "~0g0j4j4g0g ~0c0g4g4c0c", "~0d0c4c4j0j0f4f4h",
    // : ; < = > ? @
    "0c0c 0g0g", "1c0a 1g1g", "4h0f4d", "0e4e 0g4g", "0h4f0d", "~0h0j4j4g2g2e 2c2c", "~4d0d0h4h4e3e3g2g2e4e",
    // A B C D E F
    "0c2j4c 1e3e", "0c0j ~0j4j4g0g ~0g4g4c0c", "~4h4j0j0c4c4e", "0c0j ~0j4j4c0c", "4j0j0c4c 0g3g", "4j0j0c 0g3g",
    // G H I J K L M N
    "~4h4j0j0c4c4f 4f2f", "0c0j 4c4j 0g4g", "0c0j", "~3j3c0c0e", "0c0j 4j0f 1g4c", "0j0c4c", "0c0j2f4j4c", "0c0j4c4j",
    // O P Q R S T
    "~0c0j5j5c0c", "0c0j ~0j4j4f0f", "~0c0j5j5c0c 3e5b", "0c0j ~0j4j4f0f 2f4c", "~4h4j0j0g4g4c0c0e", "0j4j 2j2c",
    // U V W X Y Z
    "~0j0c4c4j", "0j2c4j", "0j1c3i5c6j", "0c4j 0j4c", "0j2f4j 2f2c", "0j4j0c4c",
    // [ \ ] ^ _ `
    "2j0j0b2b", "0j3b", "0j2j2b0b", "0h2j4h", "0b4b", "0j1i",
    // a b c d e f
    "~0c0h4h4c0c 4h4c", "0j0c ~0c0h4h4c0c", "~4g4h0h0c4c4d", "~0c0h4h4c0c 4j4c", "0f4f ~4f4h0h0c4c4d",
    "~3j1j1f 1f1c 0h3h",
    // g h i j k l
    "~0c0h4h4c0c ~4h4a0a0b", "0j0c ~0f0h4h4c 4d4c", "0h0c 0j0j", "~2h2a0a 2j2j", "0j0c 3h0e 1f3c", "0j0c",
    // m n o p q r
    "0h0c ~0f0h3h3c ~3f3h6h6c", "0h0c ~0f0h4h4c", "~0c0h4h4c0c", "0h0a ~0c0h4h4c0c", "~0c0h4h4c0c 4h4a", "0h0c ~0f0h3h",
    // s t u v w x y z
    "~3g3h0h0e3f3c0c0d", "~1j1c3c 0h3h", "~0h0c4c4h 4h4c", "0h2c4h", "0h1c3h5c6h", "0h4c 0c4h", "0h2c 4h1a", "0h4h0c4c",
    // { | } ~
    "~2j1j1g0f ~0f1f1b2b", "0j0b", "~0j1j1g2f ~2f1f1b0b", "~0f1h3d4f"};
// clang-format on

constexpr double cap_units = 7;    // height of a capital in glyph units
constexpr double gap_units = 1.9;  // between glyphs
constexpr double blank_units = 2.6;

std::string_view glyph(char c) {
  bool const known = c > ' ' && c <= '~';
  return glyphs[static_cast<std::size_t>((known ? c : '?') - '!')];
}

double glyph_width(char c) {
  if (c == ' ') return blank_units;
  double width = 0;
  for (char const digit : glyph(c)) {
    if (digit >= '0' && digit <= '9') width = std::max(width, static_cast<double>(digit - '0'));
  }
  return width;
}

/// Points along the quadratic B-spline of the control points: parabolas between the middles of the legs.
Stroke spline(Stroke const& control) {
  constexpr int pieces = 6;
  bool const closed = control.front() == control.back();
  auto const middle = [](StrokePoint a, StrokePoint b) { return StrokePoint{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2}; };
  std::size_t const n = control.size();
  Stroke out{closed ? middle(control[0], control[1]) : control[0]};
  for (std::size_t k = 1; k < n; ++k) {
    if (k + 1 == n && !closed) break;
    StrokePoint const bend = control[k];
    StrokePoint const from = out.back(), to = middle(bend, k + 1 < n ? control[k + 1] : control[1]);
    bool const corner_first = k == 1 && !closed;
    StrokePoint const start = corner_first ? middle(control[0], bend) : from;
    if (corner_first) out.push_back(start);
    for (int i = 1; i <= pieces; ++i) {
      double const s = static_cast<double>(i) / pieces, r = 1 - s;
      out.push_back({r * r * start[0] + 2 * r * s * bend[0] + s * s * to[0],
                     r * r * start[1] + 2 * r * s * bend[1] + s * s * to[1]});
    }
  }
  if (!closed) out.push_back(control.back());
  return out;
}

std::vector<Stroke> strokes(char c) {
  std::vector<Stroke> out;
  std::string_view rest = c == ' ' ? std::string_view() : glyph(c);
  while (!rest.empty()) {
    std::size_t const end = std::min(rest.find(' '), rest.size());
    std::string_view part = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    bool const smooth = part.front() == '~';
    if (smooth) part.remove_prefix(1);
    Stroke points;
    for (std::size_t i = 0; i + 1 < part.size(); i += 2)
      points.push_back({static_cast<double>(part[i] - '0'), static_cast<double>(part[i + 1] - 'c')});
    out.push_back(smooth ? spline(points) : points);
  }
  return out;
}

/// Coverage of one glyph is collected first, so that strokes that meet do not darken each other.
void draw_glyph(Image& image, StrokePoint origin, char c, double unit, double pen, Colour colour) {
  int const left = static_cast<int>(std::floor(origin[0] - pen - 1)),
            columns = static_cast<int>(glyph_width(c) * unit + 2 * pen + 4);
  int const top = static_cast<int>(std::floor(origin[1] - cap_units * unit - pen - 1)),
            rows = static_cast<int>((cap_units + 2) * unit + 2 * pen + 4);
  Image mask(columns, rows, {0, 0, 0});
  auto const place = [&](StrokePoint p) {
    return StrokePoint{origin[0] + p[0] * unit - left, origin[1] - p[1] * unit - top};
  };
  for (Stroke const& stroke : strokes(c)) {
    for (std::size_t k = 0; k + 1 < stroke.size(); ++k) {
      Image segment(columns, rows, {0, 0, 0});
      bool const dot = stroke.size() == 2 && stroke[0] == stroke[1];
      draw_line(segment, place(stroke[k]), place(stroke[k + 1]), dot ? 1.4 * pen : pen, {255, 255, 255});
      std::transform(mask.rgb.begin(), mask.rgb.end(), segment.rgb.begin(), mask.rgb.begin(),
                     [](auto a, auto b) { return std::max(a, b); });
    }
  }
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) image.blend(left + x, top + y, colour, mask.at(x, y)[0] / 255.0);
  }
}

}  // namespace

double text_width(std::string_view text, double height) {
  double units = 0;
  for (char const c : text) units += glyph_width(c) + gap_units;
  return text.empty() ? 0 : (units - gap_units) * height / cap_units;
}

void draw_text(Image& image, double x, double y, std::string_view text, double height, Colour colour, Align align) {
  double const unit = height / cap_units, pen = std::max(0.13 * height, 1.0);
  double at = x;
  if (align == Align::centre) at -= text_width(text, height) / 2;
  if (align == Align::right) at -= text_width(text, height);
  for (char const c : text) {
    draw_glyph(image, {at, y}, c, unit, pen, colour);
    at += (glyph_width(c) + gap_units) * unit;
  }
}

}  // namespace piola
