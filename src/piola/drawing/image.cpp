// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/image.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/checksum_trailer.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <png.h>

namespace piola {
namespace {

std::size_t offset(Image const& image, int x, int y) {
  return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
}

/// Red, green, blue, opacity of each pixel.
std::vector<std::uint8_t> with_alpha(Image const& image) {
  std::vector<std::uint8_t> mixed;
  mixed.reserve(4 * image.alpha.size());
  for (std::size_t i = 0; i < image.alpha.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) mixed.push_back(image.rgb[3 * i + c]);
    mixed.push_back(image.alpha[i]);
  }
  return mixed;
}

void append_number(std::vector<std::byte>& bytes, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::byte>(number >> shift & 255u));
}

/// Puts an iTXt chunk for each note before the end of a PNG file: key, that the text is not compressed and in no
/// particular language, text (PNG specification, 2nd edition, 11.3.4.5).
void add_notes(std::vector<std::byte>& png, Image const& image) {
  constexpr std::size_t end_chunk = 12;
  std::vector<std::byte> chunks;
  for (auto const& [key, text] : image.notes) {
    std::string const content = "iTXt" + key + std::string(5, '\0') + text;
    append_number(chunks, static_cast<std::uint32_t>(content.size() - 4));
    for (char const c : content) chunks.push_back(static_cast<std::byte>(c));
    CheckSum sum;
    sum.add(content);
    append_number(chunks, sum.value());
  }
  png.insert(png.end() - end_chunk, chunks.begin(), chunks.end());
}

}  // namespace

Image::Image(int columns, int rows, Colour background) : width(columns), height(rows) {
  PIOLA_EXPECTS(columns >= 0 && rows >= 0);
  rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < rgb.size(); i += 3) std::copy(background.begin(), background.end(), &rgb[i]);
}

Colour Image::at(int x, int y) const {
  auto const* p = &rgb[offset(*this, x, y)];
  return {p[0], p[1], p[2]};
}

void Image::set(int x, int y, Colour colour) { std::copy(colour.begin(), colour.end(), &rgb[offset(*this, x, y)]); }

Image without_background(Image const& on_black, Image const& on_white) {
  PIOLA_EXPECTS(on_black.width == on_white.width && on_black.height == on_white.height);
  Image out = on_black;
  out.alpha.resize(out.rgb.size() / 3);
  for (std::size_t i = 0; i < out.alpha.size(); ++i) {
    int seen_through = 0;  // by the channel that shows most of the background
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
      seen_through = std::max(seen_through, on_white.rgb[c] - on_black.rgb[c]);
    int const alpha = 255 - seen_through;
    out.alpha[i] = static_cast<std::uint8_t>(alpha);
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
      out.rgb[c] =
          static_cast<std::uint8_t>(alpha == 0 ? 0 : std::min(255, (255 * on_black.rgb[c] + alpha / 2) / alpha));
  }
  return out;
}

void write_png(std::filesystem::path const& path, Image const& image) {
  PIOLA_EXPECTS(image.rgb.size() == 3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  PIOLA_EXPECTS(image.alpha.empty() || 3 * image.alpha.size() == image.rgb.size());
  bool const opaque = image.alpha.empty();
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = opaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> const mixed = opaque ? std::vector<std::uint8_t>{} : with_alpha(image);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::vector<std::byte> bytes(size);
  void const* const pixels = opaque ? image.rgb.data() : mixed.data();
  if (!png_image_write_to_memory(&header, bytes.data(), &size, 0, pixels, 0, nullptr)) {
    throw FileError(fmt::format("{}: cannot be made, {} - choose a smaller picture", path.string(), header.message));
  }
  bytes.resize(size);
  add_notes(bytes, image);
  write_whole_file(path, bytes);
}

}  // namespace piola
