// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/panels.hpp"
#include "piola/input/case_spec.hpp"
#include <span>
#include <string>

namespace piola {

/// One panel of a picture, ready to be drawn.
struct PanelPicture {
  PictureData data;
  PictureStyle style;
  Window window;  ///< equal size for all panels
};

/// The panels of a case, or its picture alone.
std::span<PictureSpec const> panels_of(PicturesSpec const& pictures);

/// The label of a panel: its caption, else its view if that has a name.
std::string caption_of(PictureSpec const& panel);

/// Whether panels can share one colour bar: equal field, component, range and colours.
bool one_bar(std::span<PictureSpec const> panels);

/// Enlarges windows to equal size, so that panels have one scale.
void give_one_size(std::span<Window> windows);

/// The file name of a picture of panels: the picture_name of the first one, with the other fields before the number.
std::string with_other_fields(std::string name, std::span<PictureSpec const> panels);

/// Draws panels with one colour bar, in the size of the picture or, without one, a fitting size.
Image draw_sheet(std::span<Panel const> panels, Sheet const& sheet, PictureSpec const& picture, Window const& all,
                 PictureStyle style);

/// Combines panels in one picture: below one title with one bar if possible, else as adjacent pictures. `pictures`
/// gives the number of columns and optionally the size; `all`: the window of the whole run.
Image draw_together(std::span<PanelPicture const> panels, PicturesSpec const& pictures, Window const& all);

}  // namespace piola
