// SPDX-License-Identifier: Apache-2.0
#include "piola/output/image.hpp"
#include "piola/base/problems.hpp"
#include "piola/output/files.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <png.h>

namespace piola {
namespace {

std::size_t offset(Image const& image, int x, int y) {
  return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
}

double distance_to_segment(double x, double y, std::array<double, 2> a, std::array<double, 2> b) {
  double const dx = b[0] - a[0], dy = b[1] - a[1];
  double const length2 = dx * dx + dy * dy;
  double const share = length2 > 0 ? std::clamp(((x - a[0]) * dx + (y - a[1]) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(x - a[0] - share * dx, y - a[1] - share * dy);
}

png_image png_header(int width, int height) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(width);
  header.height = static_cast<png_uint_32>(height);
  header.format = PNG_FORMAT_RGB;
  return header;
}

}  // namespace

Image::Image(int columns, int rows, Colour background) : width(columns), height(rows) {
  rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = background[i % 3];
}

Colour Image::at(int x, int y) const {
  auto const* p = &rgb[offset(*this, x, y)];
  return {p[0], p[1], p[2]};
}

void Image::set(int x, int y, Colour colour) { std::copy(colour.begin(), colour.end(), &rgb[offset(*this, x, y)]); }

void Image::blend(int x, int y, Colour colour, double coverage) {
  if (x < 0 || y < 0 || x >= width || y >= height || coverage <= 0) return;
  double const share = std::min(coverage, 1.0);
  auto* p = &rgb[offset(*this, x, y)];
  for (std::size_t c = 0; c < 3; ++c) p[c] = static_cast<std::uint8_t>(std::lround(p[c] + share * (colour[c] - p[c])));
}

Image reduce(Image const& fine, int factor) {
  Image out(fine.width / factor, fine.height / factor, {0, 0, 0});
  int const samples = factor * factor;
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      std::array<int, 3> sum{};
      for (int k = 0; k < samples; ++k) {
        auto const pixel = fine.at(x * factor + k % factor, y * factor + k / factor);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += pixel[c];
      }
      Colour mean{};
      for (std::size_t c = 0; c < 3; ++c) mean[c] = static_cast<std::uint8_t>((sum[c] + samples / 2) / samples);
      out.set(x, y, mean);
    }
  }
  return out;
}

void draw_line(Image& image, std::array<double, 2> from, std::array<double, 2> to, double width, Colour colour) {
  double const reach = width / 2 + 1;
  int const x0 = static_cast<int>(std::floor(std::min(from[0], to[0]) - reach)),
            x1 = static_cast<int>(std::ceil(std::max(from[0], to[0]) + reach));
  int const y0 = static_cast<int>(std::floor(std::min(from[1], to[1]) - reach)),
            y1 = static_cast<int>(std::ceil(std::max(from[1], to[1]) + reach));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x)
      image.blend(x, y, colour, width / 2 + 0.5 - distance_to_segment(x + 0.5, y + 0.5, from, to));
  }
}

void write_png(std::filesystem::path const& path, Image const& image) {
  png_image header = png_header(image.width, image.height);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::vector<std::byte> bytes(size);
  if (!png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr)) {
    throw FileError(fmt::format("{}: cannot be made, {} - choose a smaller picture", path.string(), header.message));
  }
  write_whole_file(path, std::span<std::byte const>(bytes).first(size));
}

Image read_png(std::filesystem::path const& path) {
  png_image header = png_header(0, 0);
  bool good = png_image_begin_read_from_file(&header, path.c_str()) != 0;
  Image image;
  if (good) {
    header.format = PNG_FORMAT_RGB;
    image = Image(static_cast<int>(header.width), static_cast<int>(header.height), {0, 0, 0});
    good = png_image_finish_read(&header, nullptr, image.rgb.data(), 0, nullptr) != 0;
  }
  if (!good)
    throw FileError(fmt::format("{}: is not a PNG picture ({}) - check the file", path.string(), header.message));
  return image;
}

}  // namespace piola
