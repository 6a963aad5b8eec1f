// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/colour_map.hpp"
#include "piola/drawing/image.hpp"
#include "piola/input/picture_spec.hpp"
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Annotations of a picture: title, time, colour bar or legend, axes, scale bar.
namespace piola {

struct ThemeColours {
  Colour background, ink, faint_ink;
};
ThemeColours colours_of(Theme theme);

/// How the times of one run are written, all in one unit with the same number of decimals.
struct TimeFormat {
  double factor = 1;       ///< s
  std::string unit = "s";  ///< with a prefix
  int decimals = 3;
  std::string text(double time) const;  ///< e.g. "12.5 ms"
};
/// For times up to `longest`, `step` apart [s]. The decimals resolve the step to 1 %; at most six.
TimeFormat time_format(double longest, double step);

/// Meaning of a colour.
struct LegendEntry {
  std::string name;
  Colour colour{};
};

/// Positions of the annotations [pixels]. All sizes scale with the picture, so that letters of a large one stay
/// readable.
struct Layout {
  int width = 0, height = 0;
  double unit = 1;                                  ///< of all distances: 1 in a picture of 1000 x 800
  double small = 13, text = 16, large = 20;         ///< sizes of fonts
  double left = 0, right = 0, top = 0, bottom = 0;  ///< the area for the bodies
  bool two_rows = false;                            ///< time below a title that leaves no room to its right
};
/// Without letters the bodies have the whole picture.
Layout layout_of(int width, int height, std::string_view title, bool letters);

/// The words and numbers of a picture.
struct Overlay {
  std::string title, at_right;  ///< at_right: the time or another text
  /// A bar for these colours, unless there is a legend.
  ColourMap const* map = nullptr;
  std::string label, unit;  ///< of the values; SI
  std::array<double, 2>
      extremes{};             ///< lowest and highest finite value: the bar has a pointed end where they lie outside
  bool not_a_number = false;  ///< among the values
  std::span<LegendEntry const> legend = {};
  /// Directions on the picture (x right, y up) of the axes, as many as there are dimensions.
  std::vector<std::array<double, 2>> axes = {};
  double pixels_per_metre = 0;  ///< 0: no scale bar
};

/// A strip of this size with axes and scale bar alone.
Image draw_marks(int width, int height, Layout const& layout, Overlay const& overlay, ThemeColours const& colours,
                 bool transparent);

/// Draws them over the image.
void draw_overlay(Image& image, Layout const& layout, Overlay const& overlay, ThemeColours const& colours);

}  // namespace piola
