// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/errors.hpp"
#include "piola/drawing/image.hpp"
#include <filesystem>
#include <png.h>
#include <vector>

namespace piola::testing {

/// Reads a PNG file, without its notes. Throws FileError.
inline Image read_png(std::filesystem::path const& path) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&header, path.c_str()) == 0) throw FileError(path.string() + " is no picture");
  bool const opaque = (header.format & PNG_FORMAT_FLAG_ALPHA) == 0;
  header.format = PNG_FORMAT_RGBA;
  Image image(static_cast<int>(header.width), static_cast<int>(header.height), {0, 0, 0});
  std::vector<std::uint8_t> mixed(image.rgb.size() / 3 * 4);
  if (png_image_finish_read(&header, nullptr, mixed.data(), 0, nullptr) == 0)
    throw FileError(path.string() + " is damaged");
  for (std::size_t i = 0; i < mixed.size(); ++i)
    if (i % 4 < 3)
      image.rgb[i / 4 * 3 + i % 4] = mixed[i];
    else if (!opaque)
      image.alpha.push_back(mixed[i]);
  return image;
}

}  // namespace piola::testing
