// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/output/panels.hpp"
#include <span>
#include <string>

namespace piola {

/// One panel of a picture, ready to be drawn.
struct PanelPicture {
  PictureData data;
  PictureStyle style;
  Window window;  ///< of all panels one size
};

/// The panels of a case, or its picture alone.
std::span<PictureSpec const> panels_of(PicturesSpec const& pictures);

/// What stands at a panel: its caption, else its view if that has a name.
std::string caption_of(PictureSpec const& panel);

/// Whether panels have one bar: the same field, component, range and colours.
bool one_bar(std::span<PictureSpec const> panels);

/// Brings windows to one size, so that panels have one scale.
void give_one_size(std::span<Window> windows);

/// The name of a picture of panels: as picture_name has it for the first one, with the other fields before the number.
std::string with_other_fields(std::string name, std::span<PictureSpec const> panels);

/// Panels with one bar, of the size that the picture has or, without one, that fits.
Image draw_sheet(std::span<Panel const> panels, Sheet const& sheet, PictureSpec const& picture, Window const& all,
                 PictureStyle style);

/// Panels in one picture: below one title with one bar where that is right for all, else as pictures beside each other.
/// `pictures` says how many columns and, if anything, which size; `all`: the window of the whole run.
Image draw_together(std::span<PanelPicture const> panels, PicturesSpec const& pictures, Window const& all);

}  // namespace piola
