// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/image.hpp"
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace piola {

enum class Align { left, centre, right };

/// Font size [pixels] and colour of letters.
struct TextStyle {
  double size = 16;
  Colour colour{};
};

/// Letters, lines and areas over an image, smooth at their edges. Coordinates in pixels from the top left corner. Text
/// is UTF-8; bytes that are not, and control characters, show as '?'.
class Canvas {
 public:
  explicit Canvas(Image const& below);
  ~Canvas();
  Canvas(Canvas const&) = delete;
  Canvas& operator=(Canvas const&) = delete;

  /// (x, y) is the point of the baseline that `align` names.
  void write(double x, double y, std::string_view text, TextStyle const& letters, Align align = Align::left);
  /// A line of text that runs upwards; its middle is at y.
  void write_upwards(double x, double y, std::string_view text, TextStyle const& letters);
  /// A line through the points.
  void line(std::span<std::array<double, 2> const> points, double width, Colour colour);
  /// The area inside a closed line through the points.
  void area(std::span<std::array<double, 2> const> corners, Colour colour);

  /// Length of a line of text in a font of this size [pixels].
  double width_of(std::string_view text, double size) const;
  /// Returns the image drawn so far. Throws FileError if Cairo could not draw (e.g. for lack of memory).
  Image image() const;

 private:
  struct Drawing;
  std::unique_ptr<Drawing> drawing_;
};

/// Length of a line of text in a font of this size [pixels].
double text_width(std::string_view text, double size);
/// The part of a text that fits, with dots if some is left out.
std::string shortened(std::string_view text, double size, double width);

}  // namespace piola
