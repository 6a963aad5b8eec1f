// SPDX-License-Identifier: Apache-2.0
#include "piola/pictures/panel_pictures.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <cmath>
#include <set>

namespace piola {
namespace {

int scaled(int side, double scale) { return 2 * std::max(1, static_cast<int>(std::lround(scale * side / 2))); }

/// Adjacent pictures, each with its own bar; a caption replaces the title.
Image each_with_its_bar(std::span<PanelPicture const> panels, PicturesSpec const& pictures, int columns) {
  std::vector<Image> images;
  auto const rows =
      static_cast<int>((panels.size() + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns));
  for (std::size_t k = 0; k < panels.size(); ++k) {
    PanelPicture panel = panels[k];
    if (std::string const caption = caption_of(pictures.panels[k]); !caption.empty()) panel.data.title = caption;
    if (pictures.width > 0 && pictures.height > 0) {
      panel.style.width = std::max(1, pictures.width / columns);
      panel.style.height = std::max(1, pictures.height / rows);
    }
    images.push_back(draw_picture(panel.data, panel.style, panel.window));
  }
  return tiled(images, columns);
}

}  // namespace

std::span<PictureSpec const> panels_of(PicturesSpec const& pictures) {
  if (pictures.panels.empty()) return {static_cast<PictureSpec const*>(&pictures), 1};
  return pictures.panels;
}

std::string caption_of(PictureSpec const& panel) {
  if (!panel.caption.empty()) return panel.caption;
  bool const from_an_end = !panel.named_view.empty() && !panel.named_view.starts_with("iso");
  return from_an_end ? "from " + panel.named_view : "";
}

bool one_bar(std::span<PictureSpec const> panels) {
  return std::all_of(panels.begin(), panels.end(), [&](PictureSpec const& one) {
    PictureSpec const& first = panels.front();
    return one.field == first.field && one.component == first.component && one.range == first.range &&
           one.map == first.map;
  });
}

void give_one_size(std::span<Window> windows) {
  double wide = 0, high = 0;
  for (Window const& one : windows) {
    wide = std::max(wide, one.x1 - one.x0);
    high = std::max(high, one.y1 - one.y0);
  }
  for (Window& one : windows) {
    double const more_x = (wide - (one.x1 - one.x0)) / 2, more_y = (high - (one.y1 - one.y0)) / 2;
    one.x0 -= more_x;
    one.x1 += more_x;
    one.y0 -= more_y;
    one.y1 += more_y;
  }
}

std::string with_other_fields(std::string name, std::span<PictureSpec const> panels) {
  PIOLA_EXPECTS(!panels.empty());
  std::set<std::string> known{panels.front().field};
  for (PictureSpec const& panel : panels)
    if (known.insert(panel.field).second) name.insert(name.rfind('-'), "-" + panel.field);
  return name;
}

Image draw_sheet(std::span<Panel const> panels, Sheet const& sheet, PictureSpec const& picture, Window const& all,
                 PictureStyle style) {
  if (picture.width <= 0 || picture.height <= 0) {
    auto const size = fitting_size(all, panels.size(), sheet.columns);
    style.width = scaled(size[0], picture.scale);
    style.height = scaled(size[1], picture.scale);
  }
  return draw_panels(panels, sheet, style);
}

Image draw_together(std::span<PanelPicture const> panels, PicturesSpec const& pictures, Window const& all) {
  PIOLA_EXPECTS(!panels.empty());
  PIOLA_EXPECTS(pictures.panels.empty() || pictures.panels.size() == panels.size());
  PanelPicture const& first = panels.front();
  if (pictures.panels.empty()) return draw_picture(first.data, first.style, first.window);
  int const columns = pictures.columns > 0 ? std::min(pictures.columns, static_cast<int>(panels.size()))
                                           : fitting_columns(all, panels.size());
  if (!one_bar(pictures.panels)) return each_with_its_bar(panels, pictures, columns);
  std::vector<Panel> sheet;
  for (std::size_t k = 0; k < panels.size(); ++k)
    sheet.push_back({panels[k].data, panels[k].window, caption_of(pictures.panels[k]), &panels[k].style});
  TimeFormat const format = first.data.time_format.value_or(time_format(first.data.time, first.data.time));
  return draw_sheet(sheet, {first.data.title, "t = " + format.text(first.data.time), columns}, pictures, all,
                    first.style);
}

}  // namespace piola
