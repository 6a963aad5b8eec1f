// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace piola {

using Colour = std::array<std::uint8_t, 3>;

/// Pixels row by row from the top, 8 bits for red, green and blue.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  Image() = default;
  Image(int columns, int rows, Colour background);
  Colour at(int x, int y) const;
  void set(int x, int y, Colour colour);
  /// Mixes a colour in; coverage 0 leaves the pixel, 1 replaces it. Outside the image nothing happens.
  void blend(int x, int y, Colour colour, double coverage);
};

/// The mean of factor x factor pixels for each pixel of the result.
Image reduce(Image const& fine, int factor);

/// A straight line with round ends, smooth at its edges. Coordinates in pixels, from the top left.
void draw_line(Image& image, std::array<double, 2> from, std::array<double, 2> to, double width, Colour colour);

/// Writes a PNG file. Throws FileError.
void write_png(std::filesystem::path const& path, Image const& image);
/// Reads a PNG file. Throws FileError.
Image read_png(std::filesystem::path const& path);

}  // namespace piola
