// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/plot.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/drawing/ticks.hpp"
#include "piola/output/atomic_file.hpp"
#include <algorithm>
#include <array>
#include <cairo/cairo-pdf.h>
#include <cairo/cairo-svg.h>
#include <cairo/cairo.h>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <new>

namespace piola {
namespace {

struct Rgb {
  double r, g, b;
};
/// Colours that the colour-blind tell apart (Okabe and Ito 2008), the faint yellow left out.
constexpr std::array palette{Rgb{0, 0.447, 0.698},     Rgb{0.835, 0.369, 0}, Rgb{0, 0.620, 0.451},
                             Rgb{0.800, 0.475, 0.655}, Rgb{0, 0, 0},         Rgb{0.902, 0.624, 0},
                             Rgb{0.337, 0.706, 0.914}};

using DrawingSurface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

/// The range of one axis and its place on the paper.
struct Scale {
  bool logarithmic = false;
  double factor = 1;  ///< of the shown unit
  double low = 0, high = 1, from = 0, to = 1;
  bool shows(double v) const { return std::isfinite(v) && (!logarithmic || v > 0); }
  double at(double v) const {
    auto const place = [&](double value) { return logarithmic ? std::log10(value) : value; };
    return from + (to - from) * (place(v) - place(low)) / (place(high) - place(low));
  }
  std::vector<Tick> ticks() const {
    if (!logarithmic) return linear_ticks(low / factor, high / factor);
    auto decades = decade_ticks(low / factor, high / factor);
    return decades.size() < 2 ? linear_ticks(low / factor, high / factor) : decades;
  }
};

Scale scale_of(Plot const& plot, PlotAxis const& axis, std::vector<double> Curve::*values, bool with_air) {
  Scale scale{.logarithmic = axis.logarithmic};
  scale.low = std::numeric_limits<double>::infinity();
  scale.high = -scale.low;
  for (Curve const& curve : plot.curves)
    for (double const v : curve.*values)
      if (scale.shows(v)) {
        scale.low = std::min(scale.low, v);
        scale.high = std::max(scale.high, v);
      }
  if (!(scale.low <= scale.high))
    throw InputError(fmt::format("there is nothing to draw of {}: no value is {} - choose other columns{}", axis.name,
                                 axis.logarithmic ? "above 0" : "a finite number",
                                 axis.logarithmic ? " or a linear axis" : ""));
  scale.factor = prefix_for(std::max(std::abs(scale.low), std::abs(scale.high)), axis.unit).factor;
  constexpr double round_off = 1e-11;  // of the values: what is constant but for it is drawn as constant
  if (scale.high - scale.low <= round_off * std::max(std::abs(scale.low), std::abs(scale.high))) {
    double const air = scale.high == 0 ? 1 : 0.1 * std::abs(scale.high);
    scale.low -= scale.logarithmic ? 0.5 * scale.low : air;
    scale.high += air;
  } else if (with_air && !scale.logarithmic) {
    double const air = 0.04 * (scale.high - scale.low);
    if (scale.low != 0) scale.low -= air;
    scale.high += air;
  }
  return scale;
}

std::string axis_text(PlotAxis const& axis, Scale const& scale) {
  if (axis.unit.empty() || axis.unit == "1") return axis.name;
  return fmt::format("{} [{}{}]", axis.name, prefix_for(scale.factor, axis.unit).word, axis.unit);
}

class PlotCanvas {
 public:
  PlotCanvas(cairo_t* context, Plot const& plot) : c_(context), plot_(plot) {
    cairo_select_font_face(c_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_source_rgb(c_, 1, 1, 1);
    cairo_paint(c_);
  }

  void draw() {
    x_ = scale_of(plot_, plot_.x, &Curve::x, false);
    y_ = scale_of(plot_, plot_.y, &Curve::y, true);
    cairo_set_font_size(c_, 13);
    double room = 30;
    for (Curve const& curve : plot_.curves) room = std::max(room, width_of(curve.label) + 24);
    double left = 20;
    for (Tick const& tick : y_.ticks()) left = std::max(left, width_of(tick.text) + 46);
    x_.from = left;
    x_.to = std::max(left + 100, plot_.width - room);
    y_.from = plot_.height - 52;
    y_.to = 46;
    frame();
    for (Curve const& curve : plot_.curves) curve.marks ? rings(curve) : line(curve);
    labels();
  }
  /// After drawing.
  PlotText place() const {
    return {
        .svg = {}, .left = x_.from, .right = x_.to, .top = y_.to, .bottom = y_.from, .low = x_.low, .high = x_.high};
  }

 private:
  double width_of(std::string const& text) const {
    cairo_text_extents_t extents;
    cairo_text_extents(c_, text.c_str(), &extents);
    return extents.x_advance;
  }

  /// share: 0 begins at x, 0.5 is centred there, 1 ends there.
  void write(std::string const& text, double x, double y, double share = 0) {
    cairo_move_to(c_, x - share * width_of(text), y);
    cairo_show_text(c_, text.c_str());
  }

  void stroke(double x0, double y0, double x1, double y1) {
    cairo_move_to(c_, x0, y0);
    cairo_line_to(c_, x1, y1);
    cairo_stroke(c_);
  }

  void frame() {
    cairo_set_line_width(c_, 1);
    for (bool const grid : {true, false}) {
      double const grey = grid ? 0.88 : 0.2;
      cairo_set_source_rgb(c_, grey, grey, grey);
      for (Tick const& tick : x_.ticks()) {
        double const at = std::round(x_.at(tick.value * x_.factor)) + 0.5;
        grid ? stroke(at, y_.from, at, y_.to) : write(tick.text, at, y_.from + 18, 0.5);
      }
      for (Tick const& tick : y_.ticks()) {
        double const at = std::round(y_.at(tick.value * y_.factor)) + 0.5;
        grid ? stroke(x_.from, at, x_.to, at) : write(tick.text, x_.from - 7, at + 4.5, 1);
      }
    }
    stroke(x_.from, std::round(y_.from) + 0.5, x_.to, std::round(y_.from) + 0.5);
    write(axis_text(plot_.x, x_), (x_.from + x_.to) / 2, plot_.height - 14, 0.5);
    cairo_save(c_);
    cairo_translate(c_, 18, (y_.from + y_.to) / 2);
    cairo_rotate(c_, -std::acos(-1.0) / 2);
    write(axis_text(plot_.y, y_), 0, 0, 0.5);
    cairo_restore(c_);
    cairo_set_font_size(c_, 15);
    write(plot_.title, x_.from, 28);
    cairo_set_font_size(c_, 13);
    write(plot_.note, plot_.width - 14, 28, 1);
  }

  void set_pen(Curve const& curve) {
    Rgb const colour = palette[static_cast<std::size_t>(curve.colour) % palette.size()];
    cairo_set_source_rgb(c_, colour.r, colour.g, colour.b);
    cairo_set_line_width(c_, 1.8);
    constexpr std::array<std::array<double, 2>, 3> dashes{{{7, 4}, {2, 3}, {12, 3}}};
    if (curve.dash == 0)
      cairo_set_dash(c_, nullptr, 0, 0);
    else
      cairo_set_dash(c_, dashes[static_cast<std::size_t>(curve.dash - 1) % dashes.size()].data(), 2, 0);
  }

  /// Rows that fall on one column of pixels are drawn as first, lowest, highest, last: nothing else would be seen.
  void line(Curve const& curve) {
    set_pen(curve);
    bool pen_down = false;
    std::size_t const rows = std::min(curve.x.size(), curve.y.size());
    for (std::size_t i = 0; i < rows;) {
      if (!x_.shows(curve.x[i]) || !y_.shows(curve.y[i])) {
        pen_down = false;
        ++i;
        continue;
      }
      double const column = std::floor(x_.at(curve.x[i]));
      double const px = x_.at(curve.x[i]);
      std::array<double, 4> py{y_.at(curve.y[i]), y_.at(curve.y[i]), y_.at(curve.y[i]), y_.at(curve.y[i])};
      std::size_t last = i;
      for (; last + 1 < rows && x_.shows(curve.x[last + 1]) && y_.shows(curve.y[last + 1]) &&
             std::floor(x_.at(curve.x[last + 1])) == column;
           ++last) {
        double const y = y_.at(curve.y[last + 1]);
        py = {py[0], std::min(py[1], y), std::max(py[2], y), y};
      }
      pen_down ? cairo_line_to(c_, px, py[0]) : cairo_move_to(c_, px, py[0]);
      pen_down = true;
      if (py[1] < std::min(py[0], py[3])) cairo_line_to(c_, px, py[1]);
      if (py[2] > std::max(py[0], py[3])) cairo_line_to(c_, px, py[2]);
      if (last > i) cairo_line_to(c_, x_.at(curve.x[last]), py[3]);
      i = last + 1;
    }
    cairo_stroke(c_);
    cairo_set_dash(c_, nullptr, 0, 0);
  }

  void rings(Curve const& curve) {
    set_pen(curve);
    cairo_set_dash(c_, nullptr, 0, 0);
    for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
      if (!x_.shows(curve.x[i]) || !y_.shows(curve.y[i])) continue;
      cairo_new_sub_path(c_);
      cairo_arc(c_, x_.at(curve.x[i]), y_.at(curve.y[i]), 4.5, 0, 2 * std::acos(-1.0));
      cairo_stroke(c_);
    }
  }

  /// Names beside the last points, pushed apart where they would lie on each other.
  void labels() {
    struct Label {
      double y;
      Curve const* curve;
    };
    std::vector<Label> list;
    for (Curve const& curve : plot_.curves)
      for (std::size_t i = std::min(curve.x.size(), curve.y.size()); i-- > 0;)
        if (x_.shows(curve.x[i]) && y_.shows(curve.y[i])) {
          list.push_back({y_.at(curve.y[i]) + 4.5, &curve});
          break;
        }
    std::stable_sort(list.begin(), list.end(), [](Label const& a, Label const& b) { return a.y < b.y; });
    constexpr double apart = 16;
    for (std::size_t i = 1; i < list.size(); ++i) list[i].y = std::max(list[i].y, list[i - 1].y + apart);
    double lowest = y_.from + 4;
    for (std::size_t i = list.size(); i-- > 0; lowest = list[i].y - apart) list[i].y = std::min(list[i].y, lowest);
    for (Label const& label : list) {
      set_pen(*label.curve);
      write(label.curve->label, x_.to + 8, label.y);
    }
    write(plot_.remark, (x_.from + x_.to) / 2, (y_.from + y_.to) / 2 - 12, 0.5);
  }

  cairo_t* c_;
  Plot const& plot_;
  Scale x_, y_;
};

cairo_status_t append_to(void* text, unsigned char const* data, unsigned int length) {
  static_cast<std::string*>(text)->append(data, data + length);
  return CAIRO_STATUS_SUCCESS;
}

/// `content` takes what a vector format writes; it must outlive the surface.
DrawingSurface surface_for(std::filesystem::path const& path, Plot const& plot, std::string& content) {
  auto const extension = path.extension();
  if (extension == ".svg")
    return {cairo_svg_surface_create_for_stream(&append_to, &content, plot.width, plot.height), &cairo_surface_destroy};
  if (extension == ".pdf") {
    DrawingSurface pdf(cairo_pdf_surface_create_for_stream(&append_to, &content, plot.width, plot.height),
                       &cairo_surface_destroy);
    cairo_pdf_surface_set_metadata(pdf.get(), CAIRO_PDF_METADATA_TITLE, plot.title.c_str());
    return pdf;
  }
  if (extension == ".png")
    return {cairo_image_surface_create(CAIRO_FORMAT_RGB24, 2 * plot.width, 2 * plot.height), &cairo_surface_destroy};
  throw InputError(
      fmt::format("{}: cannot be drawn (allowed: names that end in .svg, .png or .pdf) - choose one", path.string()));
}

}  // namespace

PlotText plot_text(Plot const& plot) {
  PIOLA_EXPECTS(plot.width > 0 && plot.height > 0);
  std::string svg;
  PlotText text;
  {
    DrawingSurface const surface(cairo_svg_surface_create_for_stream(&append_to, &svg, plot.width, plot.height),
                                 &cairo_surface_destroy);
    Context const context(cairo_create(surface.get()), &cairo_destroy);
    PlotCanvas paper(context.get(), plot);
    try {
      paper.draw();
    } catch (...) {
      cairo_surface_finish(surface.get());  // while there is a text to write to
      throw;
    }
    text = paper.place();
    cairo_surface_finish(surface.get());
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) throw std::bad_alloc();
  }
  text.svg = std::move(svg);
  return text;
}

void write_plot(std::filesystem::path const& path, Plot const& plot) {
  PIOLA_EXPECTS(plot.width > 0 && plot.height > 0);
  std::string content;
  {
    DrawingSurface const surface = surface_for(path, plot, content);
    Context const context(cairo_create(surface.get()), &cairo_destroy);
    bool const pixels = path.extension() == ".png";
    if (pixels) cairo_scale(context.get(), 2, 2);
    try {
      PlotCanvas(context.get(), plot).draw();
    } catch (...) {
      cairo_surface_finish(surface.get());  // while there is a text to write to
      throw;
    }
    auto status =
        pixels ? cairo_surface_write_to_png_stream(surface.get(), &append_to, &content) : CAIRO_STATUS_SUCCESS;
    cairo_surface_finish(surface.get());
    if (status == CAIRO_STATUS_SUCCESS) status = cairo_status(context.get());
    if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface.get());
    if (status != CAIRO_STATUS_SUCCESS)
      throw FileError(
          fmt::format("{}: cannot be drawn ({}) - make it smaller", path.string(), cairo_status_to_string(status)));
  }
  write_whole_file(path, content);
}

}  // namespace piola
