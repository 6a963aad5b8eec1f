// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/image.hpp"
#include <string_view>

namespace piola {

enum class Align { left, centre, right };

/// Draws a line of printable ASCII with a pen of our own strokes; anything else shows as '?'. (x, y) is the baseline
/// point that `align` names, in pixels; `height` is that of a capital letter.
void draw_text(Image& image, double x, double y, std::string_view text, double height, Colour colour,
               Align align = Align::left);

/// Length of a line of text in pixels.
double text_width(std::string_view text, double height);

}  // namespace piola
