// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/picture.hpp"

namespace piola {

/// One of several pictures on a sheet. Does not own data and style.
struct Panel {
  PictureData const& data;
  Window window;
  std::string caption;  ///< below it
  /// View and appearance of this panel; null: those of the sheet. If set, axes and scale are drawn at each panel.
  PictureStyle const* own = nullptr;
};

/// Settings common to all panels.
struct Sheet {
  std::string title, at_right;
  int columns = 1;
};

/// Panels in rows, with one title, one colour bar and one scale: windows should have one size. The style gives view,
/// range, colours and the size of the whole picture. Without a range it is that of the first panel's data.
Image draw_panels(std::span<Panel const> panels, Sheet const& sheet, PictureStyle const& style);

/// Arranges images of equal size in rows. Empty places have the colour of the first image's corner.
Image tiled(std::span<Image const> images, int columns);

/// Width and height [pixels] of a picture of `panels` panels with this window, at most 2400 wide and high.
std::array<int, 2> fitting_size(Window const& window, std::size_t panels, int columns);

/// Number of columns for which a picture of `panels` panels with this window has a suitable aspect ratio.
int fitting_columns(Window const& window, std::size_t panels);

}  // namespace piola
