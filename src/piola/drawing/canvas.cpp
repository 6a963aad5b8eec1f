// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/canvas.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include <algorithm>
#include <cairo/cairo.h>
#include <cstring>
#include <fmt/format.h>
#include <numbers>
#include <string>

namespace piola {
namespace {

/// Bytes of the character of UTF-8 that starts here; 0 if none does.
std::size_t bytes_of_character(std::string_view text) {
  auto const byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  unsigned const first = byte(0);
  std::size_t const length = first < 0x80 ? 1 : first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (first > 0xF4 || length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(k) & 0xC0) != 0x80) return 0;
  bool const overlong = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
  bool const no_character = (first == 0xED && byte(1) > 0x9F) || (first == 0xF4 && byte(1) > 0x8F);
  return overlong || no_character ? 0 : length;
}

/// Cairo gives up at bytes that are not UTF-8.
std::string drawable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    std::size_t const length = bytes_of_character(text);
    bool const control = static_cast<unsigned char>(text[0]) < 0x20 || text[0] == 0x7F;
    if (length == 0 || control)
      out += '?';
    else
      out += text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

void choose_font(cairo_t* context, double size) {
  cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, size);
}

double width_in(cairo_t* context, std::string const& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  return extents.x_advance;
}

std::uint32_t premultiplied(Colour const& colour, unsigned alpha) {
  auto const part = [&](std::size_t c) { return (static_cast<unsigned>(colour[c]) * alpha + 127) / 255; };
  return alpha << 24 | part(0) << 16 | part(1) << 8 | part(2);
}

/// Divides a premultiplied colour component by its opacity.
std::uint32_t opaque_part(std::uint32_t part, std::uint32_t alpha) {
  return alpha == 0 ? 0 : std::min<std::uint32_t>(255, (255 * part + alpha / 2) / alpha);
}

}  // namespace

/// An image as Cairo holds it: one number per pixel, colours multiplied by their opacity.
struct Canvas::Drawing {
  int width, height;
  bool transparent;
  cairo_surface_t* surface;
  cairo_t* context;

  explicit Drawing(Image const& below)
      : width(below.width),
        height(below.height),
        transparent(!below.alpha.empty()),
        surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height)) {
    PIOLA_EXPECTS(below.rgb.size() == 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    PIOLA_EXPECTS(below.alpha.empty() || 3 * below.alpha.size() == below.rgb.size());
    for (int y = 0; y < height; ++y)
      if (unsigned char* const row = row_of(y)) put_row(below, y, row);
    cairo_surface_mark_dirty(surface);
    context = cairo_create(surface);
    // Letters then have the same shapes and places at any size and on any screen.
    cairo_font_options_t* const options = cairo_font_options_create();
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(context, options);
    cairo_font_options_destroy(options);
    cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  }
  ~Drawing() {
    cairo_destroy(context);
    cairo_surface_destroy(surface);
  }
  Drawing(Drawing const&) = delete;
  Drawing& operator=(Drawing const&) = delete;

  /// The first byte of a row; none if there was no memory for the surface.
  unsigned char* row_of(int y) const {
    unsigned char* const data = cairo_image_surface_get_data(surface);
    return data ? data + static_cast<std::ptrdiff_t>(y) * cairo_image_surface_get_stride(surface) : nullptr;
  }
  void put_row(Image const& below, int y, unsigned char* row) const {
    auto const columns = static_cast<std::size_t>(width), first = static_cast<std::size_t>(y) * columns;
    for (std::size_t x = 0; x < columns; ++x) {
      std::uint8_t const* const c = &below.rgb[3 * (first + x)];
      std::uint32_t const pixel = transparent
                                      ? premultiplied({c[0], c[1], c[2]}, below.alpha[first + x])
                                      : 255U << 24 | std::uint32_t{c[0]} << 16 | std::uint32_t{c[1]} << 8 | c[2];
      std::memcpy(row + 4 * x, &pixel, sizeof pixel);
    }
  }
  void paint_with(Colour const& c) const { cairo_set_source_rgb(context, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0); }
  void path(std::span<std::array<double, 2> const> points) const {
    cairo_new_path(context);
    for (auto const& p : points) cairo_line_to(context, p[0], p[1]);
  }
  void show(std::string const& text) const {
    cairo_show_text(context, text.c_str());
    cairo_new_path(context);
  }
};

Canvas::Canvas(Image const& below) : drawing_(std::make_unique<Drawing>(below)) {}
Canvas::~Canvas() = default;

void Canvas::write(double x, double y, std::string_view text, TextStyle const& letters, Align align) {
  PIOLA_EXPECTS(letters.size > 0);
  std::string const words = drawable(text);
  choose_font(drawing_->context, letters.size);
  drawing_->paint_with(letters.colour);
  double const share = align == Align::left ? 0 : align == Align::centre ? 0.5 : 1;
  cairo_move_to(drawing_->context, x - share * width_in(drawing_->context, words), y);
  drawing_->show(words);
}

void Canvas::write_upwards(double x, double y, std::string_view text, TextStyle const& letters) {
  cairo_save(drawing_->context);
  cairo_translate(drawing_->context, x, y);
  cairo_rotate(drawing_->context, -std::numbers::pi / 2);
  write(0, 0, text, letters, Align::centre);
  cairo_restore(drawing_->context);
}

void Canvas::line(std::span<std::array<double, 2> const> points, double width, Colour colour) {
  PIOLA_EXPECTS(width > 0);
  drawing_->path(points);
  drawing_->paint_with(colour);
  cairo_set_line_width(drawing_->context, width);
  cairo_stroke(drawing_->context);
}

void Canvas::area(std::span<std::array<double, 2> const> corners, Colour colour) {
  drawing_->path(corners);
  drawing_->paint_with(colour);
  cairo_fill(drawing_->context);
}

double Canvas::width_of(std::string_view text, double size) const {
  PIOLA_EXPECTS(size > 0);
  choose_font(drawing_->context, size);
  return width_in(drawing_->context, drawable(text));
}

Image Canvas::image() const {
  Drawing const& d = *drawing_;
  cairo_surface_flush(d.surface);
  auto status = cairo_status(d.context);
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(d.surface);
  if (status != CAIRO_STATUS_SUCCESS)
    throw FileError(fmt::format("the letters of a picture cannot be drawn ({}) - choose a smaller picture",
                                cairo_status_to_string(status)));
  Image out(d.width, d.height, {0, 0, 0});
  if (d.transparent) out.alpha.resize(out.rgb.size() / 3);
  auto const columns = static_cast<std::size_t>(d.width);
  for (int y = 0; y < d.height; ++y) {
    unsigned char const* const row = d.row_of(y);
    for (std::size_t x = 0; x < columns; ++x) {
      std::size_t const i = static_cast<std::size_t>(y) * columns + x;
      std::uint32_t pixel = 0;
      std::memcpy(&pixel, row + 4 * x, sizeof pixel);
      std::uint32_t const alpha = pixel >> 24;
      for (std::uint32_t c = 0; c < 3; ++c) {
        std::uint32_t const part = pixel >> (16 - 8 * c) & 255u;
        out.rgb[3 * i + c] = static_cast<std::uint8_t>(alpha == 255 ? part : opaque_part(part, alpha));
      }
      if (d.transparent) out.alpha[i] = static_cast<std::uint8_t>(alpha);
    }
  }
  return out;
}

double text_width(std::string_view text, double size) {
  Canvas const nothing(Image(1, 1, {0, 0, 0}));
  return nothing.width_of(text, size);
}

std::string shortened(std::string_view text, double size, double width) {
  std::string words = drawable(text);
  if (text_width(words, size) <= width) return words;
  auto const start = [&](std::size_t bytes) {  // of whole characters
    while (bytes > 0 && (static_cast<unsigned char>(words[bytes]) & 0xC0) == 0x80) --bytes;
    return words.substr(0, bytes) + "\u2026";
  };
  std::size_t fits = 0, most = words.size();
  while (fits + 1 < most) {
    std::size_t const half = (fits + most) / 2;
    (text_width(start(half), size) <= width ? fits : most) = half;
  }
  return start(fits);
}

}  // namespace piola
