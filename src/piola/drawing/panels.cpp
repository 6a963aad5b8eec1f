// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/panels.hpp"
#include "piola/base/contracts.hpp"
#include "piola/drawing/canvas.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola {
namespace {

/// Positions of the panels of a sheet.
struct PanelCells {
  Layout layout;
  int columns, rows, width, height;
  double caption;  ///< height of the caption below each panel
  PanelCells(PictureStyle const& style, Sheet const& sheet, std::size_t panels, bool marks)
      : layout(layout_of(style.width, style.height, sheet.title, style.labels)),
        columns(std::max(1, sheet.columns)),
        rows(static_cast<int>((panels + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns))),
        caption(style.labels ? (marks ? 84 * layout.unit : 2 * layout.text) : 0) {
    width = std::max(1, static_cast<int>((layout.right - layout.left) / columns));
    // Without axes of the whole there is more room below.
    double const bottom = marks && style.labels ? layout.height - 16 * layout.unit : layout.bottom;
    height = std::max(1, static_cast<int>((bottom - layout.top) / std::max(rows, 1) - caption));
  }
  int x(std::size_t k) const {
    return static_cast<int>(layout.left) + width * static_cast<int>(k % static_cast<std::size_t>(columns));
  }
  int y(std::size_t k) const {
    return static_cast<int>(layout.top +
                            (height + caption) * static_cast<double>(k / static_cast<std::size_t>(columns)));
  }
};

void paste(Image& onto, Image const& panel, int x0, int y0) {
  for (int y = 0; y < panel.height; ++y)
    for (int x = 0; x < panel.width; ++x) {
      if (x0 + x >= onto.width || y0 + y >= onto.height) continue;
      onto.set(x0 + x, y0 + y, panel.at(x, y));
      auto const at = [&](Image const& image, int column, int row) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(column);
      };
      if (!panel.alpha.empty()) onto.alpha[at(onto, x0 + x, y0 + y)] = panel.alpha[at(panel, x, y)];
    }
}

void write_captions(Image& sheet, std::span<Panel const> panels, PanelCells const& cells, Colour ink) {
  Canvas canvas(sheet);
  double const size = cells.layout.text;
  for (std::size_t k = 0; k < panels.size(); ++k)
    canvas.write(cells.x(k) + 0.5 * cells.width, cells.y(k) + cells.height + 1.2 * size,
                 shortened(panels[k].caption, size, cells.width - size), {size, ink}, Align::centre);
  sheet = canvas.image();
}

}  // namespace

Image draw_panels(std::span<Panel const> panels, Sheet const& sheet, PictureStyle const& style) {
  PIOLA_EXPECTS(style.width > 0 && style.height > 0);
  ThemeColours const colours = colours_of(style.theme);
  Image out(style.width, style.height, colours.background);
  if (style.theme == Theme::transparent) out.alpha.assign(out.rgb.size() / 3, 0);
  if (panels.empty()) return out;
  bool const marks = std::any_of(panels.begin(), panels.end(), [](Panel const& panel) { return panel.own != nullptr; });
  PanelCells const cells(style, sheet, panels.size(), marks);
  PictureData first = panels.front().data;
  PictureStyle bare = style;
  bare.labels = false;
  bare.width = cells.width;
  bare.height = cells.height;
  if (!bare.range && first.spread) bare.range = first.spread->typical;
  auto notes = out.notes;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    PictureStyle one = bare;
    if (panels[k].own) {
      one.view = panels[k].own->view;
      one.appearance = panels[k].own->appearance;
    }
    Image const panel = draw_picture(panels[k].data, one, panels[k].window);
    paste(out, panel, cells.x(k), cells.y(k));
    if (k == 0) notes = panel.notes;
    if (!marks || !style.labels) continue;
    Image const strip =
        draw_marks(cells.layout, static_cast<int>(cells.caption), panels[k].data, one, panels[k].window);
    paste(out, strip, cells.x(k), cells.y(k) + cells.height);
  }
  first.title = sheet.title;
  notes.front().second = sheet.title;
  if (style.labels) {
    draw_letters(out, cells.layout, first, bare, panels.front().window, sheet.at_right, !marks);
    write_captions(out, panels, cells, colours.ink);
  }
  out.notes = std::move(notes);
  return out;
}

Image tiled(std::span<Image const> images, int columns) {
  if (images.empty()) return {};
  Image const& first = images.front();
  auto const across = static_cast<std::size_t>(std::max(1, columns));
  auto const down = static_cast<int>((images.size() + across - 1) / across);
  Image out(first.width * static_cast<int>(across), first.height * down, first.at(0, 0));
  if (!first.alpha.empty()) out.alpha.assign(out.rgb.size() / 3, 0);
  out.notes = first.notes;
  for (std::size_t k = 0; k < images.size(); ++k)
    paste(out, images[k], first.width * static_cast<int>(k % across), first.height * static_cast<int>(k / across));
  return out;
}

int fitting_columns(Window const& window, std::size_t panels) {
  constexpr double agreeable = 1.5;  // width over height
  auto const one = fitting_size(window);
  int best = 1;
  double least = std::numeric_limits<double>::infinity();
  for (int columns = 1; columns <= static_cast<int>(panels); ++columns) {
    double const rows = std::ceil(static_cast<double>(panels) / columns);
    double const empty = rows * columns - static_cast<double>(panels);
    double const off =
        std::abs(std::log(columns * (one[0] - 174.0) / (rows * (one[1] - 132.0)) / agreeable)) + 0.3 * empty;
    if (off >= least) continue;
    least = off;
    best = columns;
  }
  return best;
}

std::array<int, 2> fitting_size(Window const& window, std::size_t panels, int columns) {
  constexpr double most = 2400, beside = 174, above_and_below = 132, caption = 32;
  auto const one = fitting_size(window);
  double const across = std::max(1, columns),
               down = std::ceil(static_cast<double>(std::max<std::size_t>(panels, 1)) / across);
  // Smaller than alone, but not so much that the whole has the size of one.
  double const scale = 1 / std::pow(across * down, 0.25);
  double const width = across * scale * (one[0] - beside),
               height = down * (scale * (one[1] - above_and_below) + caption);
  double const shrink = std::min({1.0, (most - beside) / width, (most - above_and_below) / height});
  auto const even = [](double value) { return 2 * static_cast<int>(std::lround(value / 2)); };
  return {even(shrink * width + beside), even(shrink * height + above_and_below)};
}

}  // namespace piola
