// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace piola {

using Colour = std::array<std::uint8_t, 3>;

/// Pixels row by row from the top, 8 bits for red, green and blue; and for opacity, where an image is not opaque.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
  std::vector<std::uint8_t> alpha = {};  ///< one per pixel, 0 (nothing is there) to 255; empty: opaque

  /// Metadata of an image: keys (ASCII, at most 79 characters) and texts (UTF-8).
  std::vector<std::pair<std::string, std::string>> notes = {};

  Image() = default;
  Image(int columns, int rows, Colour background);
  Colour at(int x, int y) const;
  void set(int x, int y, Colour colour);
};

/// Computes the image with opacity from its renderings on black and on white.
Image without_background(Image const& on_black, Image const& on_white);

/// Writes a PNG file, with the notes as international text chunks. Throws FileError.
void write_png(std::filesystem::path const& path, Image const& image);

}  // namespace piola
