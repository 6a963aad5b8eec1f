// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/picture.hpp"

namespace piola {

/// One of several pictures beside each other.
struct Panel {
  PictureData const& data;
  Window window;
  std::string caption;  ///< below it
  /// View and appearance, if they are its own: axes and scale then stand at each panel.
  PictureStyle const* own = nullptr;
};

/// What all panels have in common.
struct Sheet {
  std::string title, at_right;
  int columns = 1;
};

/// Panels in rows, with one title, one colour bar and one scale: windows should have one size. The style gives view,
/// range, colours and the size of the whole picture. Without a range it is that of the first panel's data.
Image draw_panels(std::span<Panel const> panels, Sheet const& sheet, PictureStyle const& style);

/// Images of one size beside each other, row by row; what is left over has the colour of the first one's corner.
Image tiled(std::span<Image const> images, int columns);

/// Width and height [pixels] of a whole picture of so many panels with this window, at most 2400 wide and high.
std::array<int, 2> fitting_size(Window const& window, std::size_t panels, int columns);

/// The number of columns with which so many panels with this window make a picture of an agreeable shape.
int fitting_columns(Window const& window, std::size_t panels);

}  // namespace piola
